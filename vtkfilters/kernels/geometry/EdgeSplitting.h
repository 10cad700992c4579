// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_EdgeSplitting_h
#define novelview_EdgeSplitting_h

#include "geometry/Camera.h"
#include "geometry/TriangleMesh.h"

#include <array>
#include <vector>

namespace novelview
{
/** A mesh with some of its edges cut. */
struct SplitMesh
{
  TriangleMesh Mesh; ///< the points of the whole one, then the middles of the edges that were cut
  std::vector<std::array<int, 2>> Ends; ///< of those edges, one pair per middle
};

/**
 * Cuts every edge that is longer than `longest` pixels in the camera's image at its middle, once,
 * and with it the triangles it belongs to into two, three or four. Edges that two triangles share
 * are cut for both, so the mesh stays as closed as it was. Edges with an end at or behind the
 * camera's plane stay whole.
 */
SplitMesh SplitLongEdges(const TriangleMesh& mesh, const Camera& camera, double longest);
}

#endif
