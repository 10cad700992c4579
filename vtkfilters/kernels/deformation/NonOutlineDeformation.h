// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_NonOutlineDeformation_h
#define novelview_NonOutlineDeformation_h

#include "core/Execution.h"
#include "deformation/Deformation.h"
#include "deformation/DeformationOptions.h"
#include "geometry/View.h"

#include <vector>

namespace novelview
{
/** A point triangulated between the key image and one secondary. */
struct SubPoint
{
  Eigen::Vector3d Position;
  double Weight; ///< w_k, the windows' similarity, 0 to 1
};

// ---- the terms, one function each; all lengths in pixel footprints ------------------------------

/** beta E_s [7]: sum of w_k |P_sub,k - P| over `secondaries`, the number looked at. */
double SubPointEnergy(const Eigen::Vector3d& point, const std::vector<SubPoint>& subPoints,
  int secondaries, double footprint);

/** beta [8]: mean of w_k over `secondaries`; an unmatched one counts 0. */
double SubPointReliability(const std::vector<SubPoint>& subPoints, int secondaries);

/**
 * E_r [10]: |mean over the neighbours of (neighbour - point) . ray|, `ray` the unit vector from the
 * novel camera's centre.
 */
double RaySmoothnessEnergy(const Eigen::Vector3d& point, const Eigen::Vector3d& ray,
  const std::vector<Eigen::Vector3d>& neighbours, double footprint);

/**
 * The point's partners: the window around its projection in the key is searched in each secondary
 * along the epipolar line through its projection there; the most similar window is triangulated
 * with the key ray.
 */
std::vector<SubPoint> MatchSecondaries(const Eigen::Vector3d& point, const std::vector<View>& views,
  int key, const std::vector<int>& secondaries, const NonOutlineOptions& options);

// ---- the stage -----------------------------------------------------------------------------------

/**
 * Moves every active point along the line through it and the novel camera's centre to the least of
 *
 *     E = beta E_s + (1 - beta) E_vh + Alpha E_r  [6]
 *
 * among the candidates within SearchPx. E_vh is the distance to the visual hull, read from the
 * silhouette field (the least over the views of the distance to the silhouette's cone). The key
 * image of a point is the one its normal points to most directly among those that see it.
 *
 * @param active per point, 1 = to be moved.
 */
DeformationResult DeformNonOutline(const TriangleMesh& mesh,
  const std::vector<std::uint8_t>& active, const std::vector<View>& views, const Camera& novel,
  const NonOutlineOptions& options = {}, const DeformationListener& listener = {},
  const Execution& execution = {});
}

#endif
