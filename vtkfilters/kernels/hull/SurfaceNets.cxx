// SPDX-License-Identifier: GPL-3.0-or-later
#include "hull/SurfaceNets.h"

#include "core/DisjointSets.h"

#include <algorithm>
#include <array>

namespace novelview
{
namespace
{
using Eigen::Vector3d;
using Eigen::Vector3i;

/** A number that orders cells by z, then y, then x; also for those one outside the lattice. */
std::uint64_t KeyOf(const Vector3i& cell)
{
  return (static_cast<std::uint64_t>(cell.z() + 1) << 42) |
    (static_cast<std::uint64_t>(cell.y() + 1) << 21) | static_cast<std::uint64_t>(cell.x() + 1);
}

/** Samples of like normals are this far apart at least, in spacings; along the lattice it is 1. */
constexpr double MinDistance = 0.7;

/** Normals are alike up to 60 degrees: the two sides of a thin sheet are not. */
constexpr double LikeCosine = 0.5;

/** Finds the samples of the cells at an offset from cells that are requested in their order. */
class OffsetCells
{
public:
  OffsetCells(const SortedCells& cells, const Vector3i& offset)
    : Cells(&cells)
    , Offset(offset)
    , At(cells.begin())
  {
  }

  std::uint64_t Key(const Vector3i& cell) const { return KeyOf(cell + this->Offset); }

  /** The place of the first sample that is not before cell + offset. */
  SortedCells::const_iterator From(const Vector3i& cell)
  {
    const std::uint64_t key = this->Key(cell);
    while (this->At != this->Cells->end() && this->At->first < key)
    {
      ++this->At;
    }
    return this->At;
  }

  /** Which one in order is cell + offset; -1 = none. */
  int Find(const Vector3i& cell)
  {
    const auto at = this->From(cell);
    const bool found = at != this->Cells->end() && at->first == this->Key(cell);
    return found ? static_cast<int>(at - this->Cells->begin()) : -1;
  }

private:
  const SortedCells* Cells;
  Vector3i Offset;
  SortedCells::const_iterator At;
};

/** Calls visit(sample, other) for each sample and all whose cells touch its own and come before. */
template <class Visit>
void ForEachTouching(
  const std::vector<CellSample>& samples, const SortedCells& cells, const Visit& visit)
{
  // Five rows of three cells in x, whose keys are consecutive.
  OffsetCells rows[5] = { { cells, { -1, -1, -1 } }, { cells, { -1, 0, -1 } },
    { cells, { -1, 1, -1 } }, { cells, { -1, -1, 0 } }, { cells, { -1, 0, 0 } } };
  for (const auto& [key, sampleId] : cells)
  {
    for (OffsetCells& row : rows)
    {
      const std::uint64_t last = row.Key(samples[sampleId].Cell) + 2;
      for (auto at = row.From(samples[sampleId].Cell); at->first <= last && at->first < key; ++at)
      {
        visit(sampleId, at->second);
      }
    }
  }
}
}

//------------------------------------------------------------------------------
SortedCells SortCells(const std::vector<CellSample>& samples)
{
  SortedCells cells(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    cells[i] = { KeyOf(samples[i].Cell), static_cast<int>(i) };
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

//------------------------------------------------------------------------------
std::vector<int> FindComponents(const std::vector<CellSample>& samples, const SortedCells& cells)
{
  DisjointSets sets(static_cast<int>(samples.size()));
  ForEachTouching(samples, cells, [&](int sample, int other) { sets.Unite(sample, other); });
  std::vector<int> components(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    components[i] = sets.Find(static_cast<int>(i));
  }
  return components;
}

//------------------------------------------------------------------------------
std::vector<char> Subsample(
  const std::vector<CellSample>& samples, const SortedCells& cells, double spacing)
{
  const double least = MinDistance * spacing;
  std::vector<char> stays(samples.size(), 1);
  ForEachTouching(samples, cells,
    [&](int sample, int other)
    {
      const CellSample& a = samples[sample];
      const CellSample& b = samples[other];
      const bool tooClose =
        (a.Point - b.Point).squaredNorm() < least * least && a.Normal.dot(b.Normal) > LikeCosine;
      stays[sample] &= !(stays[other] && tooClose);
    });
  return stays;
}

//------------------------------------------------------------------------------
TriangleMesh ConnectCells(const std::vector<CellSample>& samples, const SortedCells& cells)
{
  TriangleMesh surface;
  surface.Points.reserve(cells.size());
  // Of the edges along an axis, each from the first corner of its last cell: the other three cells.
  std::vector<OffsetCells> around[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vector3i u = -Vector3i::Unit((axis + 1) % 3);
    const Vector3i v = -Vector3i::Unit((axis + 2) % 3);
    around[axis] = { { cells, u }, { cells, u + v }, { cells, v } };
  }
  for (const auto& [key, sampleId] : cells)
  {
    const CellSample& sample = samples[sampleId];
    const int own = static_cast<int>(surface.Points.size());
    surface.Points.push_back(sample.Point);
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool inside = sample.Inside & 1;
      const bool otherInside = sample.Inside >> (1 << axis) & 1;
      if (inside == otherInside)
      {
        continue;
      }
      int ring[3] = {};
      std::transform(around[axis].begin(), around[axis].end(), ring,
        [&sample](OffsetCells& offset) { return offset.Find(sample.Cell); });
      if (std::any_of(ring, ring + 3, [](int other) { return other < 0; }))
      {
        continue;
      }
      // Counter-clockwise seen from the end of the axis, where outside is when the start is inside.
      if (!inside)
      {
        std::swap(ring[0], ring[2]);
      }
      surface.Triangles.emplace_back(own, ring[0], ring[1]);
      surface.Triangles.emplace_back(own, ring[1], ring[2]);
    }
  }
  return surface;
}
}
