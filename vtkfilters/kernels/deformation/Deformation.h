// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Deformation_h
#define novelview_Deformation_h

#include "geometry/TriangleMesh.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace novelview
{
/** The terms of a point's energy, unweighted, and their weighted sum. */
struct PointEnergy
{
  double Total = 0;
  double Photo = 0;   ///< E_s
  double Contour = 0; ///< E_c of an outline point, E_vh of any other
  double Smooth = 0;  ///< E_r
};

/** Where a deformer stands after an iteration. Everything is borrowed. */
struct DeformationState
{
  int Iteration = 0; ///< 0 = before the first move
  const TriangleMesh* Mesh = nullptr;
  const std::vector<PointEnergy>* Energies = nullptr; ///< per point; zero for points not moved
  const std::vector<std::uint8_t>* Active = nullptr;  ///< per point: 1 = this deformer moves it
  long PointsMoved = 0;                               ///< in this iteration
  double LargestMovePx = 0;                           ///< novel-view pixel footprints
};

using DeformationListener = std::function<void(const DeformationState&)>;

/** What a deformer leaves behind. */
struct DeformationResult
{
  TriangleMesh Mesh; ///< same points, possibly fewer triangles
  std::vector<PointEnergy> Energies;
  std::vector<std::uint8_t> Active;
  int Iterations = 0;
  bool Converged = false;
};
}

#endif
