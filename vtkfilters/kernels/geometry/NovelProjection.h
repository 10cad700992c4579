// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_NovelProjection_h
#define novelview_NovelProjection_h

#include "geometry/Camera.h"
#include "geometry/MeshNeighbours.h"
#include "geometry/TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace novelview
{
/** Twice the signed area of a projected triangle; negative = its outside faces the camera. */
inline double ProjectedArea(
  const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  return (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
}

/**
 * A mesh as the novel camera sees it: projections of the points, and the triangles that face the
 * camera. A deformer works on such a mesh; what faces away cannot be seen and would only hold the
 * outline fast. Points at or behind the camera's plane, and their triangles, are left out.
 */
class NovelProjection
{
public:
  NovelProjection(const TriangleMesh& mesh, const Camera& camera);

  /** The triangles with negative projected area (counter-clockwise seen, y pointing down). */
  static TriangleMesh FacingPart(const TriangleMesh& mesh, const Camera& camera);

  /** Whether a triangle's outside faces the camera, and all of it lies in front. */
  bool Faces(const Eigen::Vector3i& triangle) const;

  /** Would the triangles around a point keep their orientation if it projected to `moved`? */
  bool KeepsOrientation(const TriangleMesh& mesh, const TrianglesOfPoints& around, int pointId,
    const Eigen::Vector2d& moved) const;

  std::vector<Eigen::Vector2d> Pixels;
  std::vector<std::uint8_t> InFront; ///< whether a point lies before the camera's plane
};
}

#endif
