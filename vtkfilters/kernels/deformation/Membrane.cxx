// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/Membrane.h"

#include "geometry/NovelProjection.h"

namespace novelview
{
using Eigen::Vector2d;

void SpreadMoves(const MeshNeighbours& neighbours, const std::vector<std::uint8_t>& fixed,
  const MembraneOptions& options, std::vector<Vector2d>& moves, const Execution& execution)
{
  for (int sweep = 0; sweep < options.Sweeps; ++sweep)
  {
    const std::vector<Vector2d> before = moves;
    execution.ForEach(static_cast<std::int64_t>(moves.size()),
      [&](std::int64_t ptId)
      {
        const std::span<const int> around = neighbours.Points(static_cast<int>(ptId));
        if (fixed[ptId] || around.empty())
        {
          return;
        }
        Vector2d sum = Vector2d::Zero();
        for (const int other : around)
        {
          sum += before[other];
        }
        moves[ptId] = options.Decay * sum / static_cast<double>(around.size());
      });
  }
}

void ShortenFoldingMoves(
  const TriangleMesh& mesh, const std::vector<Vector2d>& pixels, std::vector<Vector2d>& moves)
{
  constexpr int halvings = 4;
  bool folds = true;
  for (int round = 0; folds; ++round)
  {
    folds = false;
    std::vector<std::uint8_t> tooFar(moves.size(), 0);
    for (const Eigen::Vector3i& t : mesh.Triangles)
    {
      const auto moved = [&](int corner) { return (pixels[t[corner]] + moves[t[corner]]).eval(); };
      const bool isMoved = !(moves[t[0]].isZero() && moves[t[1]].isZero() && moves[t[2]].isZero());
      if (isMoved && ProjectedArea(moved(0), moved(1), moved(2)) >= 0)
      {
        folds = true;
        tooFar[t[0]] = tooFar[t[1]] = tooFar[t[2]] = 1;
      }
    }
    for (std::size_t ptId = 0; ptId < moves.size(); ++ptId)
    {
      moves[ptId] *= !tooFar[ptId] ? 1 : (round < halvings ? 0.5 : 0);
    }
  }
}
}
