// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SurfaceNets_h
#define novelview_SurfaceNets_h

#include "geometry/TriangleMesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <utility>
#include <vector>

namespace novelview
{
/** The sample of a surface in a cell of a lattice that it passes through. */
struct CellSample
{
  Eigen::Vector3i Cell;
  Eigen::Vector3d Point;
  Eigen::Vector3d Normal; ///< outward, unit
  /** Bit n: whether corner Cell + (n & 1, n >> 1 & 1, n >> 2) is inside. */
  unsigned Inside = 0;
};

/** Keys and places of samples, ascending: by z, then y, then x of their cells. */
using SortedCells = std::vector<std::pair<std::uint64_t, int>>;

SortedCells SortCells(const std::vector<CellSample>& samples);

/** A number per sample, the same for all whose cells touch (26 neighbours) or are so connected. */
std::vector<int> FindComponents(const std::vector<CellSample>& samples, const SortedCells& cells);

/**
 * Which samples stay when, in the order of their cells, each that is too close to one that stays is
 * left out: closer than 0.7 spacings with normals within 60 degrees. Cells on a slope lie closer
 * together than the spacing, and what they add to the crust's cost they do not add to its shape.
 */
std::vector<char> Subsample(
  const std::vector<CellSample>& samples, const SortedCells& cells, double spacing);

/**
 * The surface through the samples as the lattice connects them: around every edge of the lattice
 * with one end inside, two triangles between the samples of its four cells. Its points are those of
 * `cells`, in their order. Closed where the samples are complete; not always a manifold.
 *
 * Source: Gibson, "Constrained elastic surface nets", MICCAI 1998, without the relaxation.
 */
TriangleMesh ConnectCells(const std::vector<CellSample>& samples, const SortedCells& cells);
}

#endif
