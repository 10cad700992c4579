// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PowerDiagram_h
#define novelview_PowerDiagram_h

#include "core/Execution.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace novelview
{
/** Balls as two columns of equal length, in world units. */
struct Balls
{
  std::vector<Eigen::Vector3d> Centres;
  std::vector<double> Radii;
};

/**
 * The power diagram of balls, as the regular triangulation dual to it.
 *
 * A ball without a cell is hidden: no tetrahedron contains it.
 */
struct PowerDiagram
{
  std::vector<std::array<int, 4>> Tets;      ///< ball ids, positively oriented
  std::vector<std::array<int, 4>> Neighbors; ///< tetrahedron opposite vertex i; -1 = none
  std::vector<char> Unbounded;               ///< per ball: 1 when its cell is unbounded
  std::vector<int> IncidenceStart;           ///< ball b's tetrahedra, see DelaunayComplex
  std::vector<int> Incidence;
};

/** Computes the diagram; the combinatorics are exact. Less than 4 balls, or flat: no tetrahedra. */
PowerDiagram BuildPowerDiagram(const Balls& balls, const Execution& execution);

/** Fills start and incidence (see DelaunayComplex) of tetrahedra over `count` vertices. */
void BuildIncidence(const std::vector<std::array<int, 4>>& tets, std::size_t count,
  std::vector<int>& start, std::vector<int>& incidence);
}

#endif
