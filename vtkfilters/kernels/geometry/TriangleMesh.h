// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_TriangleMesh_h
#define novelview_TriangleMesh_h

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

namespace novelview
{
/** An indexed triangle mesh. Faces are counter-clockwise seen from outside. */
struct TriangleMesh
{
  std::vector<Eigen::Vector3d> Points;
  std::vector<Eigen::Vector3i> Triangles; ///< three point ids each
};

/** The box with faces along the axes around points; empty without any. */
inline Eigen::AlignedBox3d BoundingBox(const std::vector<Eigen::Vector3d>& points)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points)
  {
    box.extend(point);
  }
  return box;
}

/** Points with their outward unit normals. */
struct OrientedPoints
{
  std::vector<Eigen::Vector3d> Points;
  std::vector<Eigen::Vector3d> Normals;
};
}

#endif
