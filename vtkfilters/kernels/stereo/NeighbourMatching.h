// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_NeighbourMatching_h
#define novelview_NeighbourMatching_h

#include "core/Execution.h"
#include "core/ImageRef.h"
#include "geometry/PixelBox.h"
#include "stereo/CostVolume.h"
#include "stereo/MatchImage.h"
#include "stereo/PlaneSweepCost.h"

#include <vector>

namespace novelview
{
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
}

#endif
