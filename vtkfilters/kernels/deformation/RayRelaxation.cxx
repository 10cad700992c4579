// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/RayRelaxation.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace novelview
{
using Eigen::Vector3d;

RayRelaxation::RayRelaxation(const MeshNeighbours& neighbours, const Camera& novel,
  const std::vector<Vector3d>& start, const std::vector<double>& surface,
  std::vector<std::uint8_t> active, double alpha, double footprint)
  : Neighbours(neighbours)
  , Novel(novel)
  , Start(start)
  , Surface(surface)
  , Active(std::move(active))
  , Alpha(alpha)
  , Footprint(footprint)
  , StartDepths(start.size())
  , Pulls(start.size(), 0)
  , Steps(start.size(), 0)
{
  double most = 0;
  for (int ptId = 0; ptId < static_cast<int>(start.size()); ++ptId)
  {
    this->StartDepths[ptId] = novel.Depth(start[ptId]);
    double sum = 0;
    for (const int other : neighbours.Points(ptId))
    {
      sum += 1 / static_cast<double>(neighbours.Points(other).size());
    }
    most = std::max(most, sum);
  }
  this->Depths = this->StartDepths;
  const double norm = 1 + std::sqrt(most);
  this->StepSize = 2 / (2 + alpha * norm * norm);
}

/** Mean over the neighbours of their depth less the point's, over the number of neighbours. */
double RayRelaxation::Pull(int ptId) const
{
  const std::span<const int> around = this->Neighbours.Points(ptId);
  double sum = 0;
  for (const int other : around)
  {
    sum += this->Depths[other];
  }
  const auto count = static_cast<double>(around.size());
  return (sum / count - this->Depths[ptId]) / count;
}

double RayRelaxation::HalfGradient(int ptId) const
{
  const std::span<const int> around = this->Neighbours.Points(ptId);
  double ofSmoothness = -this->Pulls[ptId] * static_cast<double>(around.size());
  for (const int other : around)
  {
    ofSmoothness += this->Pulls[other]; // what the move does to the neighbours' E_r
  }
  const double anchor = this->Surface[ptId] > 0 ? this->Surface[ptId] : this->StartDepths[ptId];
  return this->Depths[ptId] - anchor + this->Alpha * ofSmoothness;
}

RayRelaxation::Moves RayRelaxation::Step(const Execution& execution)
{
  const auto count = static_cast<std::int64_t>(this->Depths.size());
  execution.ForEach(count,
    [&](std::int64_t i)
    {
      const int ptId = static_cast<int>(i);
      this->Pulls[ptId] = this->Active[ptId] ? this->Pull(ptId) : 0;
    });
  execution.ForEach(count,
    [&](std::int64_t i)
    {
      const int ptId = static_cast<int>(i);
      this->Steps[ptId] = this->Active[ptId] ? -this->StepSize * this->HalfGradient(ptId) : 0;
    });
  constexpr double nothing = 1e-3;
  Moves moves;
  for (std::size_t ptId = 0; ptId < this->Depths.size(); ++ptId)
  {
    const double length = std::abs(this->Steps[ptId]) / this->Footprint;
    this->Depths[ptId] += this->Steps[ptId];
    moves.Moved += length > nothing;
    moves.Largest = std::max(moves.Largest, length);
  }
  return moves;
}

void RayRelaxation::Measure(std::vector<Vector3d>& positions, std::vector<PointEnergy>& energies,
  const Execution& execution) const
{
  const auto count = static_cast<std::int64_t>(this->Start.size());
  const Vector3d centre = this->Novel.Centre();
  positions = this->Start;
  energies.assign(this->Start.size(), PointEnergy());
  execution.ForEach(count,
    [&](std::int64_t ptId)
    {
      if (this->Active[ptId])
      {
        positions[ptId] =
          centre + this->Depths[ptId] / this->StartDepths[ptId] * (this->Start[ptId] - centre);
      }
    });
  const Vector3d axis = this->Novel.OpticalAxis();
  execution.ForEachWith(
    count, [] { return std::vector<Vector3d>(); },
    [&](std::vector<Vector3d>& around, std::int64_t ptId)
    {
      if (!this->Active[ptId])
      {
        return;
      }
      RayPoint point{ positions[ptId], this->Depths[ptId], this->StartDepths[ptId], std::nullopt };
      if (this->Surface[ptId] > 0)
      {
        point.Surface = this->Surface[ptId];
      }
      around.clear();
      for (const int other : this->Neighbours.Points(static_cast<int>(ptId)))
      {
        around.push_back(positions[other]);
      }
      energies[ptId] = FieldRayEnergy(point, axis, around, this->Alpha, this->Footprint);
    });
}
}
