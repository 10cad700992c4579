// SPDX-License-Identifier: GPL-3.0-or-later
// The two surfaces a labelled crust has, as closed and oriented triangle meshes.
#ifndef novelview_CrustSurface_h
#define novelview_CrustSurface_h

#include "crust/PowerDiagram.h"
#include "crust/TetLabels.h"
#include "geometry/TriangleMesh.h"

namespace novelview
{
/** A surface and where its points come from. */
struct CrustSurface
{
  TriangleMesh Mesh;
  std::vector<int> PointSources; ///< sample id of each point; of midpoints: the first end's
  int SplitPoints = 0;           ///< points that were doubled to make fans of their own
  int MidPoints = 0;             ///< points added on edges that four triangles or more shared
};

/**
 * The boundary of the inside tetrahedra. Points are samples, in ascending order.
 *
 * Always closed, oriented and manifold: two facets meet across an edge when the same run of inside
 * tetrahedra lies between them; a point with several fans of facets is doubled, one point per fan;
 * an edge that more than one pair of facets still shares gets a midpoint for each further pair.
 */
CrustSurface ExtractDelaunayCrust(
  const DelaunayComplex& complex, const std::vector<Side>& labels, const Execution& execution = {});

/**
 * The faces of the power diagram between inside and outside cells, each a convex polygon cut into
 * a fan of triangles; points are vertices of the power diagram.
 *
 * In the dual of a triangulation three cells meet in an edge and four in a vertex, so the boundary
 * of any union of bounded cells is a manifold and no repair is needed. Power vertices that coincide
 * (degenerate input) stay separate points, so triangles may have no area.
 *
 * Balls whose cell is unbounded must be outside.
 */
TriangleMesh ExtractPowerCrust(const PowerDiagram& diagram, const Balls& balls,
  const std::vector<Side>& labels, const Execution& execution);
}

#endif
