// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_DelaunayComplex_h
#define novelview_DelaunayComplex_h

#include "core/Execution.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace novelview
{
/**
 * The Delaunay triangulation of samples and eight far corners, as plain arrays.
 *
 * Tetrahedra are positively oriented: (p1 - p0) x (p2 - p0) . (p3 - p0) > 0. Facet i of a
 * tetrahedron is the one opposite its vertex i.
 */
struct DelaunayComplex
{
  static constexpr int NumberOfCorners = 8;

  std::vector<Eigen::Vector3d> Points; ///< the samples, then the eight far corners
  int NumberOfSamples = 0;             ///< duplicates included; they are no tetrahedron's vertex
  int NumberOfDuplicates = 0;          ///< samples that coincide with one of lower id

  std::vector<std::array<int, 4>> Tets;      ///< point ids
  std::vector<std::array<int, 4>> Neighbors; ///< tetrahedron across facet i; -1 = none
  std::vector<Eigen::Vector3d> Centres;      ///< circumcentres
  std::vector<double> Radii;                 ///< circumradii

  std::vector<int> IncidenceStart; ///< point p's tetrahedra: Incidence[IncidenceStart[p]] ..
  std::vector<int> Incidence;      ///< .. up to Incidence[IncidenceStart[p + 1]], ascending

  int NumberOfTets() const { return static_cast<int>(this->Tets.size()); }

  /** True when the tetrahedron has a far corner: it is certainly outside. */
  bool TouchesCorner(int tet) const
  {
    const std::array<int, 4>& t = this->Tets[tet];
    const int n = this->NumberOfSamples;
    return t[0] >= n || t[1] >= n || t[2] >= n || t[3] >= n;
  }

  /** The facet opposite vertex `facet`, counter-clockwise seen from outside the tetrahedron. */
  std::array<int, 3> Facet(int tet, int facet) const
  {
    static constexpr int corners[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };
    const std::array<int, 4>& t = this->Tets[tet];
    return { t[corners[facet][0]], t[corners[facet][1]], t[corners[facet][2]] };
  }

  /** Volume of a tetrahedron, in cubic world units. */
  double Volume(int tet) const;
};

/**
 * Triangulates. The far corners are those of the samples' bounding cube, grown to eight times the
 * bounding box' diagonal.
 *
 * Samples equal to within about ten trillionths of the diagonal count as duplicates. The
 * combinatorics are exact. The circumcentre of a tetrahedron so flat that rounding decides
 * where it lies is put where the circumcentre of its largest facet is, i.e. near the samples.
 *
 * Throws Error for less than four points, points that are not finite, and points in a plane
 * (also: within a billionth of the diagonal).
 */
DelaunayComplex BuildDelaunayComplex(
  const std::vector<Eigen::Vector3d>& samples, const Execution& execution);
}

#endif
