// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SearchBox_h
#define novelview_SearchBox_h

#include "geometry/View.h"

#include <Eigen/Geometry>

#include <vector>

namespace novelview
{
/**
 * The smallest axis-aligned box around the intersection of the pyramids that the silhouettes'
 * bounding rectangles span with their camera centres (six linear programs, CGAL). The object lies
 * in it. A rectangle's side that reaches the frame's border bounds nothing: the object may go on
 * beyond it, and there also beyond the sides next to it. These bound the box only if it would be
 * more than twice as large without them.
 *
 * Views need masks. Throws Error when a mask is empty, when the pyramids have no common point
 * (naming the view without which they would have one), or when they do not bound the object on
 * every side (then a box must be given).
 */
Eigen::AlignedBox3d FindSearchBox(const std::vector<View>& views);
}

#endif
