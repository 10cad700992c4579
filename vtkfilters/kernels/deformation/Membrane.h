// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Membrane_h
#define novelview_Membrane_h

#include "core/Execution.h"
#include "deformation/DeformationOptions.h"
#include "geometry/MeshNeighbours.h"
#include "geometry/TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace novelview
{
/**
 * Lets the points of a mesh follow those that move, as a membrane does: in each sweep every point
 * that is not `fixed` takes Decay times the mean of its neighbours' moves. `moves` are in the
 * picture, pixels, 0 for what is not fixed.
 */
void SpreadMoves(const MeshNeighbours& neighbours, const std::vector<std::uint8_t>& fixed,
  const MembraneOptions& options, std::vector<Eigen::Vector2d>& moves, const Execution& execution);

/**
 * Shortens moves so that no triangle flips in the picture: the corners of one that would are moved
 * half as far, again and again, and at last not at all. `pixels` are the projections of the points.
 */
void ShortenFoldingMoves(const TriangleMesh& mesh, const std::vector<Eigen::Vector2d>& pixels,
  std::vector<Eigen::Vector2d>& moves);
}

#endif
