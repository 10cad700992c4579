// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the visual hull: the lattice, and where the surface passes through it.
#ifndef novelview_HullSampling_h
#define novelview_HullSampling_h

#include "core/Execution.h"
#include "hull/SurfaceNets.h"
#include "silhouettes/SilhouetteField.h"

#include <Eigen/Core>

#include <vector>

namespace novelview
{
/** Number of a lattice's cells along a block's side. */
constexpr int BlockCells = 4;

/** The lattice: cell (i,j,k) spans Origin + Spacing * [i, i+1) x ... */
struct Lattice
{
  Eigen::Vector3d Origin;
  double Spacing;
  Eigen::Vector3i Blocks; ///< number along each axis

  Eigen::Vector3d Point(const Eigen::Vector3i& index) const
  {
    return this->Origin + this->Spacing * index.cast<double>();
  }
};

/** Blocks that the surface may pass through, in a fixed order. */
std::vector<Eigen::Vector3i> SurfaceBlocks(
  const SilhouetteField& field, const Lattice& lattice, const Execution& execution);

/**
 * Samples of the cells of these blocks, in their order. Reports the progress from 0.1 to 0.9.
 */
std::vector<CellSample> SampleBlocks(const SilhouetteField& field, const Lattice& lattice,
  const std::vector<Eigen::Vector3i>& blocks, const Execution& execution);
}

#endif
