// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/PowerDiagram.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <numeric>

namespace novelview
{
namespace
{
struct Id
{
  int Value = -1;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_3<Id, Kernel,
  CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using Cell = CGAL::Regular_triangulation_cell_base_3<Kernel,
  CGAL::Triangulation_cell_base_with_info_3<Id, Kernel>, CGAL::Discard_hidden_points>;
using Structure = CGAL::Triangulation_data_structure_3<Vertex, Cell>;
using Triangulation = CGAL::Regular_triangulation_3<Kernel, Structure>;

void InsertBalls(const Balls& balls, const Execution& execution, Triangulation& triangulation)
{
  std::vector<Kernel::Point_3> centres;
  centres.reserve(balls.Centres.size());
  for (const Eigen::Vector3d& c : balls.Centres)
  {
    centres.emplace_back(c.x(), c.y(), c.z());
  }
  std::vector<std::size_t> order(balls.Centres.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  using Map = CGAL::Pointer_property_map<Kernel::Point_3>::type;
  CGAL::spatial_sort(order.begin(), order.end(),
    CGAL::Spatial_sort_traits_adapter_3<Kernel, Map>(CGAL::make_property_map(centres)));

  Triangulation::Cell_handle hint;
  constexpr std::size_t reportEvery = 1 << 14;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const std::size_t id = order[i];
    const double weight = balls.Radii[id] * balls.Radii[id];
    const Triangulation::Vertex_handle vertex =
      triangulation.insert(Kernel::Weighted_point_3(centres[id], weight), hint);
    if (vertex != Triangulation::Vertex_handle())
    {
      // A ball that coincides with one that is in already shares its vertex; the first keeps it.
      vertex->info().Value = vertex->info().Value < 0 ? static_cast<int>(id) : vertex->info().Value;
      hint = vertex->cell();
    }
    else
    {
      hint = triangulation.infinite_cell();
    }
    if (i % reportEvery == 0)
    {
      execution.Report(0.3 + 0.4 * static_cast<double>(i) / static_cast<double>(order.size()));
    }
  }
}

void Export(Triangulation& triangulation, PowerDiagram& diagram)
{
  if (triangulation.dimension() < 3)
  {
    return;
  }
  int count = 0;
  for (Triangulation::Cell_handle cell : triangulation.finite_cell_handles())
  {
    cell->info().Value = count++;
  }
  diagram.Tets.reserve(static_cast<std::size_t>(count));
  diagram.Neighbors.reserve(static_cast<std::size_t>(count));
  for (Triangulation::Cell_handle cell : triangulation.finite_cell_handles())
  {
    std::array<int, 4> tet;
    std::array<int, 4> neighbors;
    for (int i = 0; i < 4; ++i)
    {
      tet[i] = cell->vertex(i)->info().Value;
      neighbors[i] = cell->neighbor(i)->info().Value;
    }
    diagram.Tets.push_back(tet);
    diagram.Neighbors.push_back(neighbors);
  }
}
}

void BuildIncidence(const std::vector<std::array<int, 4>>& tets, std::size_t count,
  std::vector<int>& start, std::vector<int>& incidence)
{
  start.assign(count + 1, 0);
  for (const std::array<int, 4>& tet : tets)
  {
    for (int v : tet)
    {
      ++start[v + 1];
    }
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  incidence.resize(tets.size() * 4);
  std::vector<int> next(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < tets.size(); ++i)
  {
    for (int v : tets[i])
    {
      incidence[next[v]++] = static_cast<int>(i);
    }
  }
}

PowerDiagram BuildPowerDiagram(const Balls& balls, const Execution& execution)
{
  PowerDiagram diagram;
  diagram.Unbounded.assign(balls.Centres.size(), 0);
  Triangulation triangulation;
  InsertBalls(balls, execution, triangulation);
  Export(triangulation, diagram);
  for (std::size_t i = 0; i < diagram.Tets.size(); ++i)
  {
    for (int k = 0; k < 4; ++k)
    {
      for (int other = 0; diagram.Neighbors[i][k] < 0 && other < 4; ++other)
      {
        diagram.Unbounded[diagram.Tets[i][other]] |= other != k;
      }
    }
  }
  BuildIncidence(diagram.Tets, balls.Centres.size(), diagram.IncidenceStart, diagram.Incidence);
  return diagram;
}
}
