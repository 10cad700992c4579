// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/PowerCrustSurface.h"

#include <Eigen/Dense>

#include <algorithm>
#include <utility>

namespace novelview
{
namespace
{
int IndexOf(const std::array<int, 4>& tet, int point)
{
  return static_cast<int>(std::find(tet.begin(), tet.end(), point) - tet.begin());
}

/** Power-diagram planes closer to parallel than this (sine) do not fix a vertex between them. */
constexpr double ParallelTolerance = 1e-7;

/**
 * The point with the same power to the four balls of a regular tetrahedron. Where they leave a
 * direction open (degenerate input), the solution nearest to where an inside and an outside ball
 * meet.
 */
Eigen::Vector3d PowerVertex(
  const std::array<int, 4>& tet, const Balls& balls, const std::vector<Side>& labels)
{
  int in = tet[0];
  int out = tet[0];
  for (int ball : tet)
  {
    in = labels[ball] == Side::Inside ? ball : in;
    out = labels[ball] == Side::Inside ? out : ball;
  }
  const double sum = balls.Radii[in] + balls.Radii[out];
  const Eigen::Vector3d anchor = balls.Centres[in] +
    (balls.Centres[out] - balls.Centres[in]) * (sum > 0 ? balls.Radii[in] / sum : 0.5);
  auto powerAt = [&](int ball)
  { return (balls.Centres[ball] - anchor).squaredNorm() - balls.Radii[ball] * balls.Radii[ball]; };
  Eigen::Matrix3d planes;
  Eigen::Vector3d offsets;
  for (int i = 1; i < 4; ++i)
  {
    const Eigen::Vector3d normal = balls.Centres[tet[i]] - balls.Centres[tet[0]];
    const double length = normal.norm();
    planes.row(i - 1) = normal.transpose() / length;
    offsets[i - 1] = 0.5 * (powerAt(tet[i]) - powerAt(tet[0])) / length;
  }
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> solver;
  solver.setThreshold(ParallelTolerance);
  solver.compute(planes);
  return anchor + solver.solve(offsets);
}

/** The regular tetrahedra around the edge (inside, outside), counter-clockwise from outside. */
void CollectRing(
  const PowerDiagram& diagram, int start, int inside, int outside, std::vector<int>& ring)
{
  ring.clear();
  const std::array<int, 4>& tet = diagram.Tets[start];
  const int a = IndexOf(tet, inside);
  const int b = IndexOf(tet, outside);
  int c = 0;
  while (c == a || c == b)
  {
    ++c;
  }
  int d = 6 - a - b - c;
  // (a, b, c, d) must be an even permutation: then c to d is the counter-clockwise way.
  const int order[4] = { a, b, c, d };
  int inversions = 0;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = i + 1; j < 4; ++j)
    {
      inversions += order[i] > order[j];
    }
  }
  if (inversions % 2 == 1)
  {
    std::swap(c, d);
  }
  int kept = tet[d];
  int exit = c;
  int current = start;
  do
  {
    ring.push_back(current);
    current = diagram.Neighbors[current][exit];
    const std::array<int, 4>& t = diagram.Tets[current];
    exit = IndexOf(t, kept);
    kept = t[6 - IndexOf(t, inside) - IndexOf(t, outside) - exit];
  } while (current != start);
}
}

TriangleMesh ExtractPowerCrust(const PowerDiagram& diagram, const Balls& balls,
  const std::vector<Side>& labels, const Execution& execution)
{
  TriangleMesh mesh;
  std::vector<int> pointOfTet(diagram.Tets.size(), -1);
  std::vector<int> tetOfPoint;
  std::vector<int> doneFor(balls.Radii.size(), -1); // the inside ball whose face is in already
  std::vector<int> ring;
  auto pointOf = [&](int tet)
  {
    if (pointOfTet[tet] < 0)
    {
      pointOfTet[tet] = static_cast<int>(tetOfPoint.size());
      tetOfPoint.push_back(tet);
    }
    return pointOfTet[tet];
  };
  for (int inside = 0; inside < static_cast<int>(labels.size()); ++inside)
  {
    const int begin = diagram.IncidenceStart[inside];
    const int end = diagram.IncidenceStart[inside + 1];
    for (int i = begin; labels[inside] == Side::Inside && i < end; ++i)
    {
      for (int ball : diagram.Tets[diagram.Incidence[i]])
      {
        if (labels[ball] == Side::Inside || doneFor[ball] == inside)
        {
          continue;
        }
        doneFor[ball] = inside;
        CollectRing(diagram, diagram.Incidence[i], inside, ball, ring);
        for (std::size_t k = 2; k < ring.size(); ++k)
        {
          const int first = pointOf(ring[0]);
          const int second = pointOf(ring[k - 1]);
          mesh.Triangles.emplace_back(first, second, pointOf(ring[k]));
        }
      }
    }
  }
  mesh.Points.resize(tetOfPoint.size());
  execution.ForEach(static_cast<std::int64_t>(tetOfPoint.size()),
    [&](std::int64_t i)
    { mesh.Points[i] = PowerVertex(diagram.Tets[tetOfPoint[i]], balls, labels); });
  return mesh;
}
}
