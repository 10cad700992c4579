// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PowerCrustSurface_h
#define novelview_PowerCrustSurface_h

#include "crust/PowerDiagram.h"
#include "crust/TetLabels.h"
#include "geometry/TriangleMesh.h"

#include <vector>

namespace novelview
{
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
