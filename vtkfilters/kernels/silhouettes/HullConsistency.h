// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_HullConsistency_h
#define novelview_HullConsistency_h

#include "core/Execution.h"
#include "geometry/View.h"
#include "silhouettes/SilhouetteRays.h"

#include <vector>

namespace novelview
{
struct HullConsistencyOptions
{
  double StepPx = 0.5;      ///< how far apart a ray is sampled, in the image where that is most
  double FloorPx = 16;      ///< residuals are no worse than minus this
  double SeenShare = 0.5;   ///< part of the other views that must have a point in their frame
  bool WithoutEach = false; ///< also find Without, which takes several times as long
};

/** How the other silhouettes take a ray. */
struct RayConsistency
{
  /**
   * The most, over the points of the ray, of the least, over the other views, of the signed distance
   * inside their contours, px; at least -FloorPx. A ray that meets the hull has one of at least 0.
   */
  float Residual = 0;
  Eigen::Vector3d Point = Eigen::Vector3d::Zero(); ///< where; only when it is above -FloorPx
  /** Per view: the residual without that view; only with WithoutEach. */
  std::vector<float> Without;
};

/**
 * Asks every silhouette about rays of the others, without a search box: the visual hull as seen from
 * a view is where its rays have a residual of at least 0 (the image-based visual hull of Matusik et
 * al. 2000, sampled). That works whatever the cameras are: where they make no sense, rays meet
 * nothing.
 *
 * An object whose silhouette stays clear of a side of the frame does not go on beyond that side, and
 * it is in front of every camera: points there are outside by as much as they are outside the frame.
 * Beyond a side that the silhouette reaches a view has no information, also in the corners with the
 * sides that it does not reach; points that less than SeenShare of the other views have in their
 * frame do not count.
 *
 * Views need Mask and ContourDistance, rays valid views. Throws Interrupted.
 */
std::vector<RayConsistency> FollowSilhouetteRays(const std::vector<View>& views,
  const std::vector<SilhouetteRay>& rays, const HullConsistencyOptions& options = {},
  const Execution& execution = {});
}

#endif
