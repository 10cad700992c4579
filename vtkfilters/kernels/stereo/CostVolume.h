// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CostVolume_h
#define novelview_CostVolume_h

#include "core/Execution.h"
#include "core/ImageRef.h"
#include "geometry/Camera.h"
#include "geometry/View.h"

#include <cstdint>
#include <vector>

namespace novelview
{
/** A photograph ready for matching: colour and luma of the object, everything else 0. */
struct MatchImage
{
  Camera Cam;
  Image<std::uint8_t> Pixels; ///< R, G, B, luma; luma 0 = background, at least 1 on the object
};

/**
 * Packs a view, reduced by an integer factor (box mean over the object's pixels; a pixel is object
 * when half of what it covers is).
 */
MatchImage MakeMatchImage(const View& view, int reduction);

/** A rectangle of pixels, ends included. */
struct PixelBox
{
  int X0 = 0, Y0 = 0, X1 = -1, Y1 = -1;
  int Width() const { return this->X1 - this->X0 + 1; }
  int Height() const { return this->Y1 - this->Y0 + 1; }
  bool Empty() const { return this->X1 < this->X0; }
};

/** The offsets from the base surface, world units of depth, that are tried at every pixel. */
struct DepthHypotheses
{
  double First = 0;
  double Step = 1;
  int Count = 0;
  double Offset(double label) const { return this->First + this->Step * label; }
};

struct MatchOptions
{
  int WindowRadius = 2;        ///< 5x5
  int BestNeighbours = 2;      ///< the cost is the mean over the best so many
  double ColorShare = 0.5;     ///< of the truncated colour difference; the rest is correlation
  double ColorTruncation = 40; ///< grey levels
  double Noise = 12;           ///< variance added to the correlation's denominators
};

/** Costs of every offset at every pixel of a box: ((y * Labels + label) * Width + x). */
struct CostVolume
{
  static constexpr int Unit = 1024; ///< stands for a cost of 1

  PixelBox Box;
  DepthHypotheses Labels;
  std::vector<std::int16_t> Costs;

  std::int16_t* Row(int y, int label) { return this->Costs.data() + this->RowOffset(y, label); }
  const std::int16_t* Row(int y, int label) const
  {
    return this->Costs.data() + this->RowOffset(y, label);
  }
  std::size_t RowOffset(int y, int label) const
  {
    return (static_cast<std::size_t>(y) * this->Labels.Count + label) * this->Box.Width();
  }
};

/**
 * Matches a reference photograph against its neighbours. At pixel p with base depth b and offset o, the
 * point of the reference's ray at depth b + o is looked up in each neighbour; because the base surface
 * varies from pixel to pixel, windows slant with it. Per neighbour the cost is
 *
 *     (1 - ColorShare) (1 - max(0, ZNCC)) / 2  +  ColorShare mean(min(|dRGB|, truncation)) / truncation
 *
 * over the window's pixels that are object in both (1 where those are less than a quarter), and the
 * mean of the best BestNeighbours is taken.
 *
 * Windows are summed as rows pass by, so nothing but a few rows and the volume itself is held.
 *
 * @param base depth per pixel of the reference; 0 = no base, the pixel takes no part.
 * @param last the largest offset that makes sense per pixel; beyond it the cost is 1.
 */
CostVolume MatchNeighbours(const MatchImage& reference, const Image<float>& base,
  const Image<float>& last, const std::vector<const MatchImage*>& neighbours, const PixelBox& box,
  const DepthHypotheses& labels, const MatchOptions& options, const Execution& execution = {});

/** The box around the pixels with a base. */
PixelBox BoxOfBase(const Image<float>& base);

struct SemiGlobalOptions
{
  double P1 = 0.03; ///< P1, between labels that differ by one
  double P2 = 0.2;  ///< P2, between any others
};

/**
 * Semi-global matching (Hirschmueller 2008): adds up the least costs along eight directions.
 * Returns the sums in a volume of the same shape.
 */
CostVolume AggregateSemiGlobally(const CostVolume& volume, const Image<float>& base,
  const SemiGlobalOptions& options, const Execution& execution = {});

/**
 * Depth per pixel of the frame from the least aggregated cost, refined by a parabola through it and
 * its two neighbours; 0 where there is no base. `winner` receives the label (unrefined) per pixel.
 */
Image<float> WinnerTakesAll(
  const CostVolume& aggregated, const Image<float>& base, Image<std::uint8_t>& winner);
}

#endif
