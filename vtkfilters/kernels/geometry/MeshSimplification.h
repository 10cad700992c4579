// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MeshSimplification_h
#define novelview_MeshSimplification_h

#include "core/Execution.h"
#include "geometry/TriangleMesh.h"

namespace novelview
{
struct SimplifiedMesh
{
  TriangleMesh Mesh;
  double MaxDistance = 0; ///< of the given mesh's points from it, world units
};

/**
 * Collapses edges of a closed, oriented manifold, those first whose planes lose least, until no more
 * than `triangles` are left or no edge can be collapsed. It stays what it is, and keeps its genus.
 * (CGAL's edge collapse with quadrics: Garland and Heckbert, "Surface simplification using quadric
 * error metrics", SIGGRAPH 1997.)
 *
 * Throws Error when the mesh is not a manifold with consistent orientation.
 */
SimplifiedMesh SimplifyMesh(
  const TriangleMesh& mesh, std::size_t triangles, const Execution& execution = {});

/**
 * The number of pairs of triangles that intersect in more than the edge or point that they share
 * (CGAL's checker, exact). Throws Error as SimplifyMesh() does.
 */
std::size_t CountSelfIntersections(const TriangleMesh& mesh);
}

#endif
