// SPDX-License-Identifier: GPL-3.0-or-later
#include "hull/HullSampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace novelview
{
using Eigen::Vector3d;
using Eigen::Vector3i;

namespace
{
constexpr int Corners = BlockCells + 1; ///< lattice points along a block's side

/** Samples are found to this part of the spacing. */
constexpr double Accuracy = 1.0 / (1 << 15);

/** A point with its value of the field. */
struct Probe
{
  Vector3d Point;
  double Value;
};

/**
 * The point between a (f >= 0) and b (f < 0) where f changes sign, on a's side: by secants, which
 * need two or three steps where f is smooth, and every third time by halves.
 */
Vector3d FindCrossing(const SilhouetteField& field, Probe a, Probe b, double tolerance)
{
  // Halving alone reaches the accuracy in 45 steps, unless the world's origin is so far away that
  // points cannot be distinguished that finely.
  constexpr int MaxSteps = 100;
  for (int step = 1;
       step < MaxSteps && a.Value > tolerance && (b.Point - a.Point).norm() > tolerance; ++step)
  {
    // Aims at the middle of what is good enough, so that it stops on whichever side it comes from.
    const double t = (a.Value - 0.5 * tolerance) / (a.Value - b.Value);
    const bool halve = step % 3 == 0 || !std::isfinite(b.Value);
    Probe next{ a.Point + (halve ? 0.5 : t) * (b.Point - a.Point), 0 };
    next.Value = field.Value(next.Point);
    (next.Value >= 0 ? a : b) = next;
  }
  return a.Point;
}

/**
 * Moves a point near the surface onto it: along the gradient to the other side, then back to the
 * crossing. Returns false when the surface is not met within `reach`.
 */
bool MoveOntoSurface(
  const SilhouetteField& field, const Vector3d& gradient, double reach, Vector3d& x)
{
  const Probe start{ x, field.Value(x) };
  const double slope = gradient.norm();
  if (!(slope > 0) || !std::isfinite(slope) || !std::isfinite(start.Value))
  {
    return false;
  }
  const bool inside = start.Value >= 0;
  const Vector3d direction = (inside ? -1.0 : 1.0) / slope * gradient;
  // f has a slope of about one, so |f| is the distance; walk a little further each time.
  double step = std::max(1.25 * std::abs(start.Value), 0.02 * reach);
  for (; step <= reach; step *= 1.6)
  {
    Probe beyond{ x + step * direction, 0 };
    beyond.Value = field.Value(beyond.Point);
    if ((beyond.Value >= 0) != inside)
    {
      x = FindCrossing(field, inside ? start : beyond, inside ? beyond : start, Accuracy * reach);
      return true;
    }
  }
  return false;
}

/** Samples of one block, appended in the order of its cells. */
class BlockSampler
{
public:
  BlockSampler(const SilhouetteField& field, const Lattice& lattice)
    : Field(field)
    , Grid(lattice)
  {
  }

  void Sample(const Vector3i& block, std::vector<CellSample>& out)
  {
    const Vector3i first = BlockCells * block;
    const double side = BlockCells * this->Grid.Spacing;
    this->Field.RestrictTo(this->Grid.Point(first) + Vector3d::Constant(0.5 * side),
      0.5 * std::sqrt(3.0) * side + this->Leeway(), this->BlockField);
    for (int k = 0, n = 0; k < Corners; ++k)
    {
      for (int j = 0; j < Corners; ++j)
      {
        for (int i = 0; i < Corners; ++i, ++n)
        {
          this->Values[n] = this->BlockField.Value(this->Grid.Point(first + Vector3i(i, j, k)));
        }
      }
    }
    for (int k = 0; k < BlockCells; ++k)
    {
      for (int j = 0; j < BlockCells; ++j)
      {
        for (int i = 0; i < BlockCells; ++i)
        {
          this->SampleCell(first, Vector3i(i, j, k), out);
        }
      }
    }
  }

private:
  /** How far from its cell a sample's search may look: the spacing, and the gradient's step. */
  double Leeway() const { return 1.25 * this->Grid.Spacing; }

  double ValueAt(const Vector3i& corner) const
  {
    return this->Values[(corner.z() * Corners + corner.y()) * Corners + corner.x()];
  }

  /** The bits of CellSample::Inside. */
  unsigned InsideCorners(const Vector3i& cell) const
  {
    unsigned inside = 0;
    for (int corner = 0; corner < 8; ++corner)
    {
      const Vector3i at = cell + Vector3i(corner & 1, (corner >> 1) & 1, corner >> 2);
      inside |= static_cast<unsigned>(this->ValueAt(at) >= 0) << corner;
    }
    return inside;
  }

  void SampleCell(const Vector3i& first, const Vector3i& cell, std::vector<CellSample>& out)
  {
    Vector3d sum = Vector3d::Zero();
    Vector3d gradient = Vector3d::Zero(); // the cell's mean one, of whatever length
    Probe anyInside{ Vector3d::Zero(), 0 };
    Probe anyOutside{ Vector3d::Zero(), 0 };
    int crossings = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int edge = 0; edge < 4; ++edge)
      {
        Vector3i from = cell;
        from[(axis + 1) % 3] += edge & 1;
        from[(axis + 2) % 3] += edge >> 1;
        const Vector3i to = from + Vector3i::Unit(axis);
        const double a = this->ValueAt(from);
        const double b = this->ValueAt(to);
        gradient[axis] += b - a;
        if ((a >= 0) == (b >= 0))
        {
          continue;
        }
        const Vector3d pointA = this->Grid.Point(first + from);
        const Vector3d pointB = this->Grid.Point(first + to);
        const double t = std::isfinite(a) && std::isfinite(b) ? a / (a - b) : 0.5;
        sum += pointA + t * (pointB - pointA);
        const Probe ends[2] = { { pointA, a }, { pointB, b } };
        anyInside = ends[a >= 0 ? 0 : 1];
        anyOutside = ends[a >= 0 ? 1 : 0];
        ++crossings;
      }
    }
    if (crossings == 0)
    {
      return;
    }
    CellSample sample;
    sample.Cell = first + cell;
    sample.Inside = this->InsideCorners(cell);
    sample.Point = sum / crossings;
    const double spacing = this->Grid.Spacing;
    this->BlockField.RestrictTo(this->Grid.Point(sample.Cell) + Vector3d::Constant(0.5 * spacing),
      0.5 * std::sqrt(3.0) * spacing + this->Leeway(), this->CellField);
    if (!MoveOntoSurface(this->CellField, gradient, spacing, sample.Point))
    {
      sample.Point = FindCrossing(this->CellField, anyInside, anyOutside, Accuracy * spacing);
    }
    sample.Normal = -this->CellField.Gradient(sample.Point, 0.25 * spacing).normalized();
    out.push_back(sample);
  }

  const SilhouetteField& Field;
  const Lattice& Grid;
  SilhouetteField BlockField; ///< the same in a block
  SilhouetteField CellField;  ///< and in a cell
  std::array<double, Corners * Corners * Corners> Values;
};
}

std::vector<Vector3i> SurfaceBlocks(
  const SilhouetteField& field, const Lattice& lattice, const Execution& execution)
{
  int size = 1;
  while (size < lattice.Blocks.maxCoeff())
  {
    size *= 2;
  }
  std::vector<Vector3i> cubes{ Vector3i::Zero() };
  const double blockSize = lattice.Spacing * BlockCells;
  for (;; size /= 2)
  {
    std::vector<std::uint8_t> keep(cubes.size());
    const double half = 0.5 * size * blockSize;
    execution.ForEach(static_cast<std::int64_t>(cubes.size()),
      [&](std::int64_t i)
      {
        if ((cubes[i].array() >= lattice.Blocks.array()).any())
        {
          return;
        }
        const Vector3d centre =
          lattice.Origin + blockSize * cubes[i].cast<double>() + Vector3d::Constant(half);
        keep[i] = field.Classify(centre, std::sqrt(3.0) * half) == SilhouetteField::Position::Mixed;
      });
    std::vector<Vector3i> next;
    for (std::size_t i = 0; i < cubes.size(); ++i)
    {
      if (!keep[i])
      {
        continue;
      }
      if (size == 1)
      {
        next.push_back(cubes[i]);
        continue;
      }
      for (int child = 0; child < 8; ++child)
      {
        next.push_back(cubes[i] + size / 2 * Vector3i(child & 1, (child >> 1) & 1, child >> 2));
      }
    }
    cubes = std::move(next);
    if (size == 1)
    {
      return cubes;
    }
  }
}

std::vector<CellSample> SampleBlocks(const SilhouetteField& field, const Lattice& lattice,
  const std::vector<Vector3i>& blocks, const Execution& execution)
{
  std::vector<std::vector<CellSample>> perBlock(blocks.size());
  const std::size_t chunk = 4096;
  for (std::size_t begin = 0; begin < blocks.size(); begin += chunk)
  {
    const std::size_t count = std::min(chunk, blocks.size() - begin);
    execution.ForEachWith(
      static_cast<std::int64_t>(count), [&] { return BlockSampler(field, lattice); },
      [&](BlockSampler& sampler, std::int64_t i)
      { sampler.Sample(blocks[begin + i], perBlock[begin + i]); });
    execution.Report(0.1 + 0.8 * static_cast<double>(begin + count) / blocks.size());
  }
  std::vector<CellSample> samples;
  for (const auto& part : perBlock)
  {
    samples.insert(samples.end(), part.begin(), part.end());
  }
  return samples;
}
}
