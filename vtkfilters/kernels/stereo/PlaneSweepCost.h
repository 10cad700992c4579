// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PlaneSweepCost_h
#define novelview_PlaneSweepCost_h

#include "stereo/MatchImage.h"
#include "stereo/ReferenceDepthOptions.h"
#include "stereo/ReferenceRows.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace novelview
{
/**
 * Window costs of one neighbour at one offset, row after row. Each row is sampled once; the sums
 * over the window's rows are kept per column as rows enter and leave. The sums are whole numbers,
 * so that neither the order nor the taking away costs a bit.
 */
class PlaneSweepCost
{
public:
  PlaneSweepCost(const ReferenceRows& rows, const MatchImage& other, const MatchOptions& options);

  /** Begins anew at this offset. */
  void Start(double offset);

  /** Lets row y enter the windows; to be called for y = -Radius, -Radius + 1, ... */
  void Enter(int y);

  /**
   * Costs (0 to CostVolume::Unit) of the pixels in the span of the row whose windows end with
   * the row entered last; costs[0] is the box's first pixel. False, and nothing is written, where
   * no window holds anything.
   */
  bool Costs(std::int16_t* costs);

private:
  /** Where a row's rays meet the neighbour. */
  struct Hits
  {
    std::vector<std::int32_t> First;   ///< pixel above and left of the hit
    std::vector<std::int32_t> Nearest; ///< -1 where there is none
    std::vector<std::int32_t> Down;    ///< share of the pixels below, 1/128
    std::vector<float> Right;          ///< share of the pixels on the right
  };
  /** What the pixels of a row add to their columns; all 0 where either is not object. */
  struct Samples
  {
    ReferenceRows::Span Span;
    std::vector<std::uint8_t> Count, Reference, Other, Difference;
    void Clear();
  };
  struct Columns
  {
    std::vector<std::uint16_t> Count, Reference, Other, Difference;
    std::vector<std::int32_t> Reference2, Other2, Product;
  };

  void Project(int y, const ReferenceRows::Span& span);
  void Gather(const ReferenceRows::Span& span);
  void Compare(int y, Samples& row) const;
  void Replace(const Samples& in, const Samples& out);
  Samples& RowOf(int y) { return this->Ring[(y + 4 * this->Side) % (this->Side + 1)]; }

  const ReferenceRows& Rows;
  const MatchImage& Other;
  const int Side;
  const float ShareOfColor;
  const float Noise;
  const float LevelsPerGrey; ///< of Difference: 255 = ColorTruncation
  Eigen::Matrix3f H;         ///< pixel (x, y) at depth d of the reference projects to
  Eigen::Vector3f E;         ///< H (x, y, 1) d + E of the neighbour
  float Offset = 0;
  int Newest = 0;
  Hits Hit;
  std::vector<float> Picked; ///< R, G, B, luma of the neighbour, times 128
  std::vector<Samples> Ring;
  Columns Sum;
};
}

#endif
