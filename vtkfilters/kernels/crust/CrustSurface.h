// SPDX-License-Identifier: GPL-3.0-or-later
// The boundary of the inside tetrahedra as a closed and oriented triangle mesh.
#ifndef novelview_CrustSurface_h
#define novelview_CrustSurface_h

#include "crust/DelaunayComplex.h"
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
}

#endif
