// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Poles_h
#define novelview_Poles_h

#include "crust/DelaunayComplex.h"
#include "crust/PowerDiagram.h"

#include <algorithm>

namespace novelview
{
/** The poles of all samples: circumspheres of Delaunay tetrahedra, each listed once. */
struct Poles
{
  std::vector<int> Tets;     ///< the tetrahedron a pole is the circumcentre of, ascending
  struct Balls Balls;        ///< polar balls, in the same order
  std::vector<char> Certain; ///< 1 when the ball touches a far corner: certainly outside
  /** Per sample the tetrahedra of its two poles, farthest first; -1 = none (duplicates). */
  std::vector<std::array<int, 2>> OfSample;
};

/**
 * Finds the poles. The first is the farthest vertex of the sample's Voronoi cell, the second the
 * farthest one in the half space away from the first; on the convex hull, away from the mean
 * direction of all Voronoi vertices that belong to far corners.
 *
 * Tetrahedra that meet in a facet and have the same circumsphere (to a ten millionth of the
 * radius: cospherical samples) are one Voronoi vertex and give one pole.
 *
 * @param allCertain also lists the spheres through far corners that are no sample's pole. With them
 *   the outside balls leave no gap around the shape, and every inside power cell is bounded.
 */
Poles FindPoles(const DelaunayComplex& complex, bool allCertain, const Execution& execution);

/**
 * The cos of the angle between the radii of two balls at a point where their boundaries meet:
 * 1 = the same ball, -1 = touching from outside. Clamped to [-1, 1].
 */
inline double BallAgreement(
  const Eigen::Vector3d& centreA, double radiusA, const Eigen::Vector3d& centreB, double radiusB)
{
  const double cosine =
    (radiusA * radiusA + radiusB * radiusB - (centreA - centreB).squaredNorm()) /
    (2 * radiusA * radiusB);
  return std::clamp(cosine, -1.0, 1.0);
}
}

#endif
