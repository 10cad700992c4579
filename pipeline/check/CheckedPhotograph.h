// SPDX-License-Identifier: GPL-3.0-or-later
/** Measurements of single photographs of a data set. */
#ifndef novelview_CheckedPhotograph_h
#define novelview_CheckedPhotograph_h

#include "check/CheckedSilhouettes.h"
#include "masks/Coverage.h"
#include "masks/Silhouette.h"

#include <string>
#include <vector>

namespace novelview
{
/** A photograph that has been inspected. */
struct CheckedPhotograph
{
  std::string Name;
  int Width = 0; ///< 0 = it cannot be read
  int Height = 0;
  FoundMask Mask;
  Coverage Covered;     ///< by the object, in the mask as it is used
  double Sharpness = 0; ///< see MeasureSharpness(); 0 = unknown
  /** Median luma of the object, 0 to 255. */
  double Brightness = 0;
  /** Part of the object that is clipped at the top in some channel, 0 to 1. */
  double Clipped = 0;
  std::vector<std::string> Warnings; ///< about its tones, one sentence each
  std::vector<std::string> Problems; ///< what cannot be read or does not fit, one sentence each
};

/**
 * Reads a photograph and its mask, or extracts the silhouette where there is none, and measures
 * them. What cannot be read or does not fit becomes a problem, not an error.
 */
CheckedPhotograph InspectPhotograph(
  const Photograph& photograph, bool forceSilhouette, const SilhouetteOptions& silhouette);

/**
 * How fine the finest structures of an image are, whatever they show: the mean difference of the
 * luma from itself blurred by 1 px over that between 1 and 3 px blur, where the mask (grown by
 * 3 px) is. About 1 for fine texture, 0.2 for an image blurred by 2 px. 0 where there is nothing.
 */
double MeasureSharpness(
  const ImageRef<const std::uint8_t>& color, const ImageRef<const std::uint8_t>& mask);

/**
 * Which values stand out: further from the median than `factor` (as a ratio, above 1), and than
 * four standard deviations, estimated from the median deviation. Negative side only with `below`
 * alone. Values that are 0 are unknown and never stand out.
 */
struct OutlierSides
{
  bool Below = true;
  bool Above = true;
};
std::vector<std::size_t> FindOutliers(
  const std::vector<double>& values, double factor, const OutlierSides& sides);
}

#endif
