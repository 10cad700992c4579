// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SilhouetteRays_h
#define novelview_SilhouetteRays_h

#include "geometry/View.h"

#include <Eigen/Core>

#include <vector>

namespace novelview
{
/** A ray from a view's centre through a pixel of its picture. */
struct SilhouetteRay
{
  int ViewId = 0;
  Eigen::Vector2d Pixel = Eigen::Vector2d::Zero();
};

/** About `count` rays of a view, through pixels of its silhouette that lie evenly over its area. */
std::vector<SilhouetteRay> AreaRays(const std::vector<View>& views, int viewId, int count);

/**
 * About `count` rays of a view, through points evenly along its contour, which are found to a tenth
 * of a pixel; not where the contour runs along the frame.
 */
std::vector<SilhouetteRay> ContourRays(const std::vector<View>& views, int viewId, int count);
}

#endif
