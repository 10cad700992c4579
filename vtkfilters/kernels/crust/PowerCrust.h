// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PowerCrust_h
#define novelview_PowerCrust_h

#include "core/Execution.h"
#include "crust/PowerCrustOptions.h"
#include "geometry/TriangleMesh.h"

#include <vector>

namespace novelview
{
/** Polar balls: the samples' approximation of the medial balls. */
struct MedialBalls
{
  std::vector<Eigen::Vector3d> Centres;
  std::vector<double> Radii; ///< world units
  std::vector<char> Inner;   ///< 1 = inside the shape, 0 = outside
};

struct PowerCrustResult
{
  TriangleMesh Mesh; ///< closed, oriented outwards, edge- and vertex-manifold

  /**
   * Per point the input point it is. Empty for PowerCrust. A point twice here: the surface touches
   * itself there and was cut apart. A midpoint of a split edge carries one of the edge's ends.
   */
  std::vector<int> PointSources;

  MedialBalls Balls;

  int DuplicatePoints = 0;   ///< input points equal to an earlier one; not used
  int UnusedPoints = 0;      ///< input points that are not on the surface, duplicates included
  int RemovedComponents = 0; ///< pieces and cavities dropped as noise
  int SplitPoints = 0;       ///< points doubled to make the surface manifold
  int MidPoints = 0;         ///< points added for that
};

/**
 * Surface of samples, after the power crust.
 *
 *  1. Delaunay triangulation of the samples and eight far corners.
 *  2. Poles: per sample the farthest vertex of its Voronoi cell, and the farthest one on the other
 *     side of the sample.
 *  3. Poles are labelled inside or outside, most certain first, from the far corners on; the other
 *     Voronoi vertices follow the one whose ball theirs agrees with best (PropagateLabels).
 *  4. PowerCrust: the power diagram of the polar balls (radius = distance to the sample); its faces
 *     between inside and outside, triangulated.
 *     DelaunayCrust: small components are dropped; tetrahedra are relabelled where the boundary is not
 *     manifold; samples just off the surface are brought back; the boundary of the inside
 *     tetrahedra is extracted, and what is still not manifold is split.
 *
 * Differs from the paper: labels spread between the poles of neighbouring samples, not of
 * neighbouring power cells, and a pole sums all its evidence (see LabelPoles), so DelaunayCrust needs
 * no power diagram; cospherical samples give one pole; normals may help; no balls are thrown away
 * for noise; the samples themselves can be the vertices.
 *
 * Limits: noise of half the sampling distance (standard deviation) is fine; noise of a whole one
 * breaks the labelling, and the surface is then still a manifold but not the shape. PowerCrust is
 * not repaired topologically: noise can leave it handles that DelaunayCrust has not.
 *
 * @param points  samples of a closed surface, any order; world units
 * @param normals null, or one outward normal of any length per point (zero or NaN = unknown)
 *
 * Throws Error for bad options, a wrong number of normals, less than four points, points that are
 * not finite or lie in one plane, and when nothing is inside.
 *
 * Amenta, Choi, Kolluri: The power crust. ACM Solid Modeling 2001.
 */
PowerCrustResult ComputePowerCrust(const std::vector<Eigen::Vector3d>& points,
  const std::vector<Eigen::Vector3d>* normals, const PowerCrustOptions& options,
  const Execution& execution);
}

#endif
