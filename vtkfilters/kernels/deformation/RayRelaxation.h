// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_RayRelaxation_h
#define novelview_RayRelaxation_h

#include "core/Execution.h"
#include "deformation/FieldEnergy.h"
#include "geometry/Camera.h"
#include "geometry/MeshNeighbours.h"

#include <cstdint>
#include <vector>

namespace novelview
{
/**
 * Minimises the sum of FieldRayEnergy() over the active points of a mesh, each of which moves along
 * its novel ray; the others stay.
 *
 * The sum is quadratic in the depths. Its second derivative lies between 2 and 2 M in every direction,
 *
 *     M = 1 + alpha (1 + sqrt q)^2,   q = max over j of the sum over the neighbours i of j of 1/n_i
 *
 * (n_i = number of i's neighbours). All points step at once by 2/(1 + M) of half the gradient, an
 * under-relaxed Jacobi step: the sum falls in every iteration, and what is left to go shrinks at least
 * by (M - 1)/(M + 1), for alpha = 0.15 about a third.
 */
class RayRelaxation
{
public:
  /**
   * @param neighbours of the mesh, start its points: borrowed.
   * @param surface of each point, the depth of the surface on its ray, 0 = none; borrowed.
   * @param active per point, 1 = it moves; it lies before the camera and has neighbours.
   * @param footprint world size of a pixel.
   */
  RayRelaxation(const MeshNeighbours& neighbours, const Camera& novel,
    const std::vector<Eigen::Vector3d>& start, const std::vector<double>& surface,
    std::vector<std::uint8_t> active, double alpha, double footprint);

  /** How far the points went, pixel footprints. */
  struct Moves
  {
    long Moved = 0; ///< by more than a thousandth
    double Largest = 0;
  };

  /** One iteration. */
  Moves Step(const Execution& execution = {});

  /** Where the points are, and their energies; 0 of points that do not move. */
  void Measure(std::vector<Eigen::Vector3d>& positions, std::vector<PointEnergy>& energies,
    const Execution& execution = {}) const;

private:
  double Pull(int ptId) const;
  double HalfGradient(int ptId) const;

  const MeshNeighbours& Neighbours;
  const Camera& Novel;
  const std::vector<Eigen::Vector3d>& Start;
  const std::vector<double>& Surface;
  const std::vector<std::uint8_t> Active;
  const double Alpha;
  const double Footprint;
  double StepSize = 1;
  std::vector<double> StartDepths;
  std::vector<double> Depths;
  std::vector<double> Pulls; ///< the root of E_r with its sign, over the number of neighbours
  std::vector<double> Steps;
};
}

#endif
