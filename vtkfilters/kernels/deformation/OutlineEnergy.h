// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OutlineEnergy_h
#define novelview_OutlineEnergy_h

#include "geometry/Rasteriser.h"
#include "geometry/View.h"

#include <optional>
#include <vector>

namespace novelview
{
/**
 * The moving direction in the picture: from the projection to the centroid of the background pixels
 * of the 5x5 window around it, unit length. Nothing when the window is all model or all background,
 * or the centroid is the centre. Pixels outside the frame are neither.
 */
std::optional<Eigen::Vector2d> OutlineDirection(
  const ItemBuffer& silhouette, const Eigen::Vector2d& projection);

/**
 * Does the projection lie on the contour of the silhouette: are there model and background among its
 * pixel and the four beside it?
 */
bool OnContour(const ItemBuffer& silhouette, const Eigen::Vector2d& projection);

/**
 * E_s [2]: mean WindowMatcher::ContrastDifference of the key with each secondary; the worst, 1,
 * without any.
 */
double OutlinePhotoEnergy(const Eigen::Vector3d& point, const std::vector<View>& views, int key,
  const std::vector<int>& secondaries, int windowRadius);

/** E_c [4]: mean over the near views of min(d, sigma) / sigma; 0 when none sees the point. */
double OutlineContourEnergy(const Eigen::Vector3d& point, const std::vector<View>& views,
  const std::vector<int>& nearViews, double sigmaPx);

/**
 * E_r [5]: mean over the neighbours of |direction . unit(neighbour - point)|; 0 on a straight
 * outline, 0 without neighbours. `direction` is a unit vector.
 */
double OutlineSmoothnessEnergy(const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
  const std::vector<Eigen::Vector3d>& neighbours);
}

#endif
