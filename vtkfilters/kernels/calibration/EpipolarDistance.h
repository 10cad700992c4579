// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_EpipolarDistance_h
#define novelview_EpipolarDistance_h

#include "geometry/Camera.h"

namespace novelview
{
/**
 * How far two pixels are from showing one point, pixels: the first-order (Sampson) distance from
 * the epipolar constraint (Hartley and Zisserman 2004, equation 11.9). 0 for cameras with a common
 * centre.
 */
double EpipolarDistance(const Camera& first, const Eigen::Vector2d& firstPixel,
  const Camera& second, const Eigen::Vector2d& secondPixel);
}

#endif
