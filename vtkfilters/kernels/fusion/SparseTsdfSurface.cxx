// SPDX-License-Identifier: GPL-3.0-or-later
// The surface of a SparseTsdf.
#include "fusion/SparseTsdf.h"

#include <cmath>

namespace novelview
{
namespace
{
using Eigen::Vector3d;
using Eigen::Vector3i;

/** The value that a point gets that becomes solid, footprints: just so. */
constexpr float Filled = -0.05F;

/** The point at which the surface passes through a cell, from its first corner, in cells. */
Vector3d MeanCrossing(const std::array<float, 8>& values)
{
  Vector3d sum = Vector3d::Zero();
  int crossings = 0;
  for (int edge = 0; edge < 24; ++edge)
  {
    const int corner = edge / 3;
    const int other = corner | 1 << edge % 3;
    const double a = values[corner];
    const double b = values[other];
    if (corner != other && (a > 0) != (b > 0))
    {
      const Vector3i at(corner & 1, corner >> 1 & 1, corner >> 2);
      sum += at.cast<double>() + a / (a - b) * Vector3d::Unit(edge % 3);
      ++crossings;
    }
  }
  return sum / crossings;
}
}

//------------------------------------------------------------------------------
int SparseTsdf::CornersToFill(int block, int point) const
{
  std::array<float, 8> values;
  if (!this->Cell(block, point, values))
  {
    return 0;
  }
  int solid = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    solid |= (values[corner] > 0 ? 0 : 1) << corner;
  }
  // The least certain of two free corners.
  const auto fill = [&values](int a, int b) { return 1 << (values[a] <= values[b] ? a : b); };
  // Opposite corners against the other six.
  for (int corner = 0; corner < 4; ++corner)
  {
    const int pair = 1 << corner | 1 << (7 - corner);
    if (solid == (0xFF & ~pair))
    {
      return fill(corner, 7 - corner);
    }
    if (solid == pair)
    {
      return 1 << (corner ^ 1) | 1 << (corner ^ 3);
    }
  }
  for (int face = 0; face < 6; ++face)
  {
    const int u = 1 << (face / 2 + 1) % 3;
    const int v = 1 << (face / 2 + 2) % 3;
    const int first = face % 2 << face / 2;
    const int square[4] = { first, first | u, first | u | v, first | v };
    const bool is[4] = { bool(solid >> square[0] & 1), bool(solid >> square[1] & 1),
      bool(solid >> square[2] & 1), bool(solid >> square[3] & 1) };
    if (is[0] == is[2] && is[1] == is[3] && is[0] != is[1])
    {
      return is[0] ? fill(square[1], square[3]) : fill(square[0], square[2]);
    }
  }
  return 0;
}

//------------------------------------------------------------------------------
void SparseTsdf::MakeManifold(const Execution& execution)
{
  for (bool changed = true; changed;)
  {
    changed = false;
    std::vector<std::array<std::uint8_t, Size>> fills(this->Blocks.size());
    execution.ForEach(this->NumberOfBlocks(),
      [&](std::int64_t i)
      {
        for (int n = 0; n < Size; ++n)
        {
          fills[i][n] = static_cast<std::uint8_t>(this->CornersToFill(static_cast<int>(i), n));
        }
      });
    for (int n = 0; n < this->NumberOfBlocks() * Size; ++n)
    {
      for (int corner = 0; corner < 8 && fills[n / Size][n % Size]; ++corner)
      {
        if (fills[n / Size][n % Size] >> corner & 1)
        {
          const Place place = this->Find(n / Size, PointOf(n % Size) + CornerOf(corner));
          this->Blocks[place.Block].Values[place.Point] = Filled;
          changed = true;
        }
      }
    }
    this->Grow(this->Blocks.size(), execution);
  }
}

//------------------------------------------------------------------------------
void SparseTsdf::SampleCells(
  int block, std::vector<Vector3d>& points, std::array<int, Size>& numbers) const
{
  for (int n = 0; n < Size; ++n)
  {
    numbers[n] = -1;
    std::array<float, 8> values;
    if (!this->Cell(block, n, values))
    {
      continue;
    }
    const Vector3d at = MeanCrossing(values);
    if (at.allFinite())
    {
      numbers[n] = static_cast<int>(points.size());
      const Vector3i first = Side * this->Blocks[block].At + PointOf(n);
      points.push_back(this->Origin + this->Spacing * (first.cast<double>() + at));
    }
  }
}

//------------------------------------------------------------------------------
void SparseTsdf::AddTriangles(
  int block, const std::vector<std::array<int, Size>>& numbers, TriangleMesh& mesh) const
{
  for (int n = 0; n < Size; ++n)
  {
    const Vector3i at = PointOf(n);
    const bool solid = this->Blocks[block].Values[n] <= 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Place next = this->Find(block, at + Vector3i::Unit(axis));
      if (next.Block < 0 || solid == (this->Blocks[next.Block].Values[next.Point] <= 0))
      {
        continue;
      }
      // The four cells around the edge, counter-clockwise seen from its end.
      const Vector3i u = Vector3i::Unit((axis + 1) % 3);
      const Vector3i v = Vector3i::Unit((axis + 2) % 3);
      int ring[4];
      const Vector3i cells[4] = { at, at - u, at - u - v, at - v };
      for (int k = 0; k < 4; ++k)
      {
        const Place place = this->Find(block, cells[solid ? k : 3 - k]);
        ring[k] = numbers[place.Block][place.Point];
      }
      // Cut along the shorter diagonal.
      const auto length = [&](int a, int b)
      { return (mesh.Points[ring[a]] - mesh.Points[ring[b]]).squaredNorm(); };
      const int first = length(0, 2) <= length(1, 3) ? 0 : 1;
      mesh.Triangles.emplace_back(ring[first], ring[first + 1], ring[first + 2]);
      mesh.Triangles.emplace_back(ring[first], ring[first + 2], ring[(first + 3) % 4]);
    }
  }
}

//------------------------------------------------------------------------------
TriangleMesh SparseTsdf::Surface(const Execution& execution) const
{
  std::vector<std::vector<Vector3d>> points(this->Blocks.size());
  std::vector<std::array<int, Size>> numbers(this->Blocks.size());
  execution.ForEach(this->NumberOfBlocks(),
    [&](std::int64_t i) { this->SampleCells(static_cast<int>(i), points[i], numbers[i]); });
  TriangleMesh mesh;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const int first = static_cast<int>(mesh.Points.size());
    for (int& number : numbers[i])
    {
      number += number < 0 ? 0 : first;
    }
    mesh.Points.insert(mesh.Points.end(), points[i].begin(), points[i].end());
  }
  for (int block = 0; block < this->NumberOfBlocks(); ++block)
  {
    execution.CheckCancelled();
    if (this->Blocks[block].Crossed)
    {
      this->AddTriangles(block, numbers, mesh);
    }
  }
  return mesh;
}
}
