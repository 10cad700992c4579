// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ViewSelection_h
#define novelview_ViewSelection_h

#include "geometry/View.h"

#include <vector>

namespace novelview
{
/** Views ordered by the angle of their optical axis to a direction, least first. */
std::vector<int> ViewsByAngle(const std::vector<View>& views, const Eigen::Vector3d& direction);

/** For every view the `count` other views nearest to it in angle. */
std::vector<std::vector<int>> NearestNeighbours(const std::vector<View>& views, int count);

/** Median over the views of one pixel's world size at a point; 0 when it is behind all. */
double MedianFootprint(const std::vector<View>& views, const Eigen::Vector3d& at);

/** The same at the centre of the box around points; 0 when there are none. */
double MedianFootprint(const std::vector<View>& views, const std::vector<Eigen::Vector3d>& points);
}

#endif
