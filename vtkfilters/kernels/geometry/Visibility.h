// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Visibility_h
#define novelview_Visibility_h

#include "core/Execution.h"
#include "geometry/Camera.h"
#include "geometry/TriangleMesh.h"
#include "geometry/VisibilityOptions.h"

#include <cstdint>
#include <vector>

namespace novelview
{
/**
 * Which vertices the centre of projection sees (Chia et al. 2013, section 2.1): a triangle seen
 * from the centre spans an infinite triangular cone; a vertex in that cone and behind the triangle
 * is invisible. The triangle's own corners are not behind it. "Behind" means deeper by more than
 * `tolerance` times the diagonal of the mesh's bounding box.
 *
 * Vertices at or behind the camera's plane are invisible; a triangle with such a corner hides
 * nothing. The frame is ignored: a vertex may be visible and outside the image.
 *
 * Computed exactly by the definition: vertices are compared with just those triangles whose
 * projection overlaps theirs, found in a grid over the image plane. n log n, not n^2.
 *
 * @return one value per point, 1 = visible.
 */
std::vector<std::uint8_t> VisibleVertices(const TriangleMesh& mesh, const Camera& camera,
  double tolerance = VisibilityOptions().Tolerance, const Execution& execution = {});

/** Does the cone of triangle `cellId` hide vertex `pointId`? The definition, for tests. */
bool HidesVertex(const TriangleMesh& mesh, const Camera& camera, int cellId, int pointId,
  double absoluteTolerance);

/** Is a point inside a closed mesh? By the winding number. */
bool IsInside(const TriangleMesh& mesh, const Eigen::Vector3d& point);

/** The diagonal of the points' bounding box. */
double BoundingDiagonal(const std::vector<Eigen::Vector3d>& points);
}

#endif
