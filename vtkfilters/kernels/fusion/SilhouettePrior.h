// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SilhouettePrior_h
#define novelview_SilhouettePrior_h

#include "core/Execution.h"
#include "fusion/TsdfField.h"
#include "geometry/TriangleMesh.h"

#include <vector>

namespace novelview
{
struct SilhouettePriorOptions
{
  FusionOptions Fusion{ 3, 0.05, 0.12 };
  double AcceptedLoss = 0.01; ///< part of a silhouette that may be declared empty
  double Min = 0.12;
  double Max = 10;
  double Noise = 1;        ///< error of the maps, pixel footprints (DepthNoise)
  int Keys = 6;            ///< photographs looked at, evenly spread
  int PixelsPerKey = 1500; ///< about so many pixels of each
};

/**
 * The prior w0m of "this ray meets object" (FusionOptions::SilhouettePrior), found from the data
 * without any truth: a photograph's own depth map is left out, its silhouette is made from those of
 * the others, and the pixels of its mask that are then declared empty are counted. The result is
 * the least prior with which no more than AcceptedLoss of them are, between Min and Max. Votes of maps
 * that are in error by more than a footprint weigh 1/Noise^2: what the prior exceeds Min by grows by
 * Noise^2. Where twice the error is more than the truncation, Min itself grows by the square of that
 * ratio.
 *
 * Clean masks and cameras need next to none; masks that disagree need more.
 *
 * Views need ContourDistance, DepthMap and Confidence; `hull` is a closed mesh around the object.
 */
double FindSilhouettePrior(const std::vector<View>& views, const TriangleMesh& hull,
  const SilhouettePriorOptions& options = {}, const Execution& execution = {});
}

#endif
