// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_evaluation_Landscape_h
#define novelview_evaluation_Landscape_h

#include <string>
#include <vector>

namespace novelview::evaluation
{
/** Offsets at which energies are looked at, from -Range to Range; 0 = the truth. */
struct Offsets
{
  double Range; ///< pixels
  double Step;

  int Count() const { return 2 * this->Side() + 1; }
  int Side() const { return static_cast<int>(this->Range / this->Step + 0.5); }
  double operator[](int i) const { return (i - this->Side()) * this->Step; }
};

/** What the energies of many points look like about the truth. */
struct LandscapeSummary
{
  int Points = 0;
  double NearShare = 0; ///< share of the points whose least energy is within a pixel of the truth
  double MedianOffset = 0;   ///< of the least energies, pixels
  double MedianDistance = 0; ///< of the same without their signs
  double MedianValley = 0;   ///< see ValleyDepth()
};

/** Where the least of some energies is; the lowest offset of equal ones. */
double LeastOffset(const Offsets& offsets, const std::vector<double>& energies);

/**
 * How much the energies rise from their least to both sides within `sidePx`: the lower of the highest
 * ones on either side, less the least.
 */
double ValleyDepth(const Offsets& offsets, const std::vector<double>& energies, double sidePx);

/** An energy along the moving directions of points whose true position is known. */
class Landscape
{
public:
  Landscape(std::string name, const Offsets& offsets)
    : Name(std::move(name))
    , Along(offsets)
  {
  }

  /** The energies of a point, one for each offset. */
  void Add(const std::vector<double>& energies);

  LandscapeSummary Summary() const;
  /** Over the points, one for each offset. */
  std::vector<double> Mean() const;

  const std::string Name;
  const Offsets Along;

private:
  std::vector<std::vector<double>> Points;
};
}

#endif
