// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/DelaunayComplex.h"

#include "core/Error.h"
#include "crust/Circumsphere.h"
#include "crust/PowerDiagram.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace novelview
{
namespace
{
/** The id of a vertex or cell; -1 until it is set. */
struct Id
{
  int Value = -1;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_3<Id, Kernel>;
using Cell = CGAL::Triangulation_cell_base_with_info_3<Id, Kernel,
  CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_3<Vertex, Cell>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, Structure>;

/** How far from the bounding box' centre the far corners are, in diagonals, along each axis. */
constexpr double CornerDistance = 4;

/** Samples that agree when rounded to this part of the far corners' diagonal count as one. */
constexpr double DuplicateTolerance = 1e-12;

/** Points whose extent across some plane is below this part of the diagonal count as coplanar. */
constexpr double FlatnessTolerance = 1e-9;
Kernel::Point_3 ToKernel(const Eigen::Vector3d& p)
{
  return { p.x(), p.y(), p.z() };
}

void CheckSamples(const std::vector<Eigen::Vector3d>& samples)
{
  if (samples.size() < 4)
  {
    throw Error("power crust", "too few points", std::to_string(samples.size()), "at least 4");
  }
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    if (!samples[i].allFinite())
    {
      throw Error("power crust", "point " + std::to_string(i) + " is not finite");
    }
  }
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : samples)
  {
    mean += p / static_cast<double>(samples.size());
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : samples)
  {
    spread += (p - mean) * (p - mean).transpose();
  }
  const Eigen::Vector3d normal =
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
  double across = 0;
  double reach = 0;
  for (const Eigen::Vector3d& p : samples)
  {
    across = std::max(across, std::abs(normal.dot(p - mean)));
    reach = std::max(reach, (p - mean).norm());
  }
  if (reach > 0 && !std::isnormal(reach * reach * reach * reach))
  {
    throw Error("power crust", "points are too far apart or too close together to compute with",
      std::to_string(reach), "an extent between 1e-75 and 1e75");
  }
  if (!(across > FlatnessTolerance * reach))
  {
    throw Error(
      "power crust", "all " + std::to_string(samples.size()) + " points lie in one plane");
  }
}

std::vector<Eigen::Vector3d> FarCorners(const std::vector<Eigen::Vector3d>& samples)
{
  Eigen::Vector3d low = samples.front();
  Eigen::Vector3d high = samples.front();
  for (const Eigen::Vector3d& p : samples)
  {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Eigen::Vector3d centre = 0.5 * (low + high);
  const double reach = CornerDistance * (high - low).norm();
  std::vector<Eigen::Vector3d> corners;
  corners.reserve(DelaunayComplex::NumberOfCorners);
  for (int i = 0; i < DelaunayComplex::NumberOfCorners; ++i)
  {
    corners.push_back(
      centre + reach * Eigen::Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  }
  return corners;
}

/** The samples that stay when all but the first of those that round alike are dropped. */
std::vector<std::size_t> DistinctSamples(
  const std::vector<Eigen::Vector3d>& points, std::size_t numberOfSamples, double resolution)
{
  struct Rounded
  {
    std::array<double, 3> Cell;
    std::size_t Id;
  };
  std::vector<Rounded> rounded(numberOfSamples);
  for (std::size_t i = 0; i < numberOfSamples; ++i)
  {
    const Eigen::Vector3d cell = ((points[i] - points[0]) / resolution).array().round();
    // Adding zero turns -0 into 0, so that equal cells compare equal bit for bit too.
    rounded[i] = { { cell.x() + 0.0, cell.y() + 0.0, cell.z() + 0.0 }, i };
  }
  std::sort(rounded.begin(), rounded.end(),
    [](const Rounded& a, const Rounded& b)
    { return a.Cell != b.Cell ? a.Cell < b.Cell : a.Id < b.Id; });
  std::vector<std::size_t> ids;
  ids.reserve(numberOfSamples);
  for (std::size_t i = 0; i < numberOfSamples; ++i)
  {
    if (i == 0 || rounded[i].Cell != rounded[i - 1].Cell)
    {
      ids.push_back(rounded[i].Id);
    }
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

/**
 * Inserts the corners, then the samples along a space-filling curve. Returns the duplicates.
 *
 * The corners come first because all samples are then inside the convex hull from the start, whose
 * facets between nearly coplanar samples cost as much as all the rest.
 */
int InsertPoints(const std::vector<Eigen::Vector3d>& points, int numberOfSamples,
  const Execution& execution, Triangulation& triangulation)
{
  // The last corner less the first one is the cube's diagonal.
  const double cube =
    (points.back() - points[points.size() - DelaunayComplex::NumberOfCorners]).norm();
  std::vector<std::size_t> order =
    DistinctSamples(points, static_cast<std::size_t>(numberOfSamples), DuplicateTolerance * cube);
  const int duplicates = numberOfSamples - static_cast<int>(order.size());
  std::vector<Kernel::Point_3> kernelPoints(points.size());
  std::transform(points.begin(), points.end(), kernelPoints.begin(), ToKernel);
  using Map = CGAL::Pointer_property_map<Kernel::Point_3>::type;
  CGAL::spatial_sort(order.begin(), order.end(),
    CGAL::Spatial_sort_traits_adapter_3<Kernel, Map>(CGAL::make_property_map(kernelPoints)));

  Triangulation::Vertex_handle hint;
  for (std::size_t i = static_cast<std::size_t>(numberOfSamples); i < points.size(); ++i)
  {
    hint = triangulation.insert(kernelPoints[i], hint);
    hint->info().Value = static_cast<int>(i);
  }
  constexpr std::size_t reportEvery = 1 << 14;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    hint = triangulation.insert(kernelPoints[order[i]], hint);
    hint->info().Value = static_cast<int>(order[i]);
    if (i % reportEvery == 0)
    {
      execution.Report(0.3 * static_cast<double>(i) / static_cast<double>(order.size()));
    }
  }
  return duplicates;
}

/** The vertices of a cell, an even permutation of its own that starts with the lowest two it can. */
std::array<int, 4> OrderedVertices(Triangulation::Cell_handle cell)
{
  std::array<int, 4> tet;
  for (int i = 0; i < 4; ++i)
  {
    tet[i] = cell->vertex(i)->info().Value;
  }
  // Two swaps, or a turn of three, keep the orientation.
  const auto lowest = std::min_element(tet.begin(), tet.end()) - tet.begin();
  if (lowest > 0)
  {
    std::swap(tet[0], tet[lowest]);
    std::swap(tet[lowest % 3 + 1], tet[(lowest + 1) % 3 + 1]);
  }
  std::rotate(tet.begin() + 1, std::min_element(tet.begin() + 1, tet.end()), tet.end());
  return tet;
}

/** A cell with its vertices. */
struct NamedCell
{
  std::array<int, 4> Tet;
  Triangulation::Cell_handle Cell;
};

/** The finite cells in ascending order of their vertices. */
std::vector<NamedCell> SortedCells(
  const Triangulation& triangulation, std::size_t numberOfPoints, const Execution& execution)
{
  std::vector<NamedCell> cells;
  cells.reserve(triangulation.number_of_vertices() * 7);
  std::vector<int> start(numberOfPoints + 1, 0); // of the cells with this lowest vertex
  for (Triangulation::Cell_handle cell : triangulation.finite_cell_handles())
  {
    cells.push_back({ OrderedVertices(cell), cell });
    ++start[cells.back().Tet[0] + 1];
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<int> next(start.begin(), start.end() - 1);
  std::vector<NamedCell> sorted(cells.size());
  for (const NamedCell& cell : cells)
  {
    sorted[next[cell.Tet[0]]++] = cell;
  }
  execution.ForEach(static_cast<std::int64_t>(numberOfPoints),
    [&](std::int64_t ptId)
    {
      std::sort(sorted.begin() + start[ptId], sorted.begin() + start[ptId + 1],
        [](const NamedCell& a, const NamedCell& b) { return a.Tet < b.Tet; });
    });
  return sorted;
}

void ExportTets(
  const Triangulation& triangulation, const Execution& execution, DelaunayComplex& complex)
{
  const std::vector<NamedCell> cells = SortedCells(triangulation, complex.Points.size(), execution);
  complex.Tets.resize(cells.size());
  complex.Neighbors.resize(cells.size());
  execution.ForEach(complex.NumberOfTets(),
    [&](std::int64_t tet)
    {
      complex.Tets[tet] = cells[tet].Tet;
      cells[tet].Cell->info().Value = static_cast<int>(tet);
    });
  execution.ForEach(complex.NumberOfTets(),
    [&](std::int64_t tet)
    {
      const Triangulation::Cell_handle cell = cells[tet].Cell;
      for (int i = 0; i < 4; ++i)
      {
        const int ptId = cell->vertex(i)->info().Value;
        const auto& t = complex.Tets[tet];
        // -1 for infinite cells
        complex.Neighbors[tet][std::find(t.begin(), t.end(), ptId) - t.begin()] =
          cell->neighbor(i)->info().Value;
      }
    });
}
}

double DelaunayComplex::Volume(int tet) const
{
  const std::array<int, 4>& t = this->Tets[tet];
  const Eigen::Vector3d& base = this->Points[t[0]];
  return (this->Points[t[1]] - base)
           .cross(this->Points[t[2]] - base)
           .dot(this->Points[t[3]] - base) /
    6;
}

DelaunayComplex BuildDelaunayComplex(
  const std::vector<Eigen::Vector3d>& samples, const Execution& execution)
{
  CheckSamples(samples);
  DelaunayComplex complex;
  complex.NumberOfSamples = static_cast<int>(samples.size());
  complex.Points = samples;
  const std::vector<Eigen::Vector3d> corners = FarCorners(samples);
  complex.Points.insert(complex.Points.end(), corners.begin(), corners.end());

  Triangulation triangulation;
  complex.NumberOfDuplicates =
    InsertPoints(complex.Points, complex.NumberOfSamples, execution, triangulation);
  ExportTets(triangulation, execution, complex);
  complex.Centres.resize(complex.Tets.size());
  complex.Radii.resize(complex.Tets.size());
  execution.ForEach(complex.NumberOfTets(),
    [&complex](std::int64_t tet) { ComputeCircumsphere(complex, static_cast<int>(tet)); });
  BuildIncidence(complex.Tets, complex.Points.size(), complex.IncidenceStart, complex.Incidence);
  return complex;
}
}
