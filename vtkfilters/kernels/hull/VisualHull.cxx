// SPDX-License-Identifier: GPL-3.0-or-later
#include "hull/VisualHull.h"

#include "core/ToInt.h"
#include "geometry/ViewSelection.h"
#include "hull/SurfaceNets.h"
#include "silhouettes/SearchBox.h"
#include "silhouettes/SilhouetteField.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace novelview
{
namespace
{
using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr int BlockCells = 4;           ///< lattice cells along a block's side
constexpr int Corners = BlockCells + 1; ///< lattice points along a block's side
constexpr int MaxBlocks = 1 << 18;      ///< along a side of the lattice

/** The lattice: cell (i,j,k) spans Origin + Spacing * [i, i+1) x ... */
struct Lattice
{
  Vector3d Origin;
  double Spacing;
  Vector3i Blocks; ///< number along each axis

  Vector3d Point(const Vector3i& index) const
  {
    return this->Origin + this->Spacing * index.cast<double>();
  }
};

double FootprintAt(const std::vector<View>& views, const Vector3d& at)
{
  const double footprint = MedianFootprint(views, at);
  if (footprint <= 0)
  {
    throw Error("visual hull", "the middle of the search box lies behind every camera");
  }
  return footprint;
}

/** Blocks that the surface may pass through, in a fixed order; and whether one is all inside. */
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
  // points cannot be told apart so finely.
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

/**
 * Leaves the samples that are far enough from each other, of all components or of the largest; and
 * makes the surface through all of these components' samples.
 */
void KeepComponents(std::vector<CellSample>& samples, bool keepAll, VisualHullResult& result)
{
  SortedCells cells = SortCells(samples);
  const std::vector<int> components = FindComponents(samples, cells);
  const std::vector<char> stays = Subsample(samples, cells, result.Spacing);
  std::vector<std::size_t> sizes(samples.size());
  for (const int component : components)
  {
    ++sizes[component];
  }
  result.Components = static_cast<int>(
    std::count_if(sizes.begin(), sizes.end(), [](std::size_t size) { return size > 0; }));
  const int largest =
    static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  const auto wanted = [&](int sample) { return keepAll || components[sample] == largest; };
  std::vector<CellSample> kept;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    if (stays[i] && wanted(static_cast<int>(i)))
    {
      kept.push_back(samples[i]);
    }
    result.DroppedSamples += stays[i] && !wanted(static_cast<int>(i));
  }
  result.DroppedComponents = keepAll ? 0 : result.Components - 1;
  std::erase_if(cells, [&](const auto& cell) { return !wanted(cell.second); });
  result.Surface = ConnectCells(samples, cells);
  samples = std::move(kept);
}

/**
 * Names the view that empties the hull: on a coarse lattice, the one that alone rejects the most
 * points all others accept.
 */
[[noreturn]] void ThrowEmpty(const std::vector<View>& views, const Eigen::AlignedBox3d& box)
{
  std::size_t most = 0;
  const View* culprit = nullptr;
  for (const View& view : views)
  {
    std::vector<View> others;
    for (const View& other : views)
    {
      if (&other != &view)
      {
        others.push_back(other);
      }
    }
    const SilhouetteField field(others);
    std::size_t accepted = 0;
    constexpr int steps = 40;
    for (int n = 0; n < steps * steps * steps; ++n)
    {
      const Vector3i cell(n % steps, n / steps % steps, n / (steps * steps));
      const Vector3d at = cell.cast<double>() + Vector3d::Constant(0.5);
      accepted += field.Value(box.min() + box.sizes().cwiseProduct(at / steps)) >= 0;
    }
    if (accepted > most)
    {
      most = accepted;
      culprit = &view;
    }
  }
  if (culprit)
  {
    throw Error("view " + culprit->Name,
      "its mask carves everything away; without it the visual hull is not empty: its mask or "
      "camera is wrong");
  }
  throw Error("visual hull",
    "it is empty in the search box, and no single view is to blame: check the box, masks and "
    "cameras");
}

void CheckInsideBox(const std::vector<CellSample>& samples, const VisualHullResult& result)
{
  Eigen::AlignedBox3d extent;
  for (const CellSample& sample : samples)
  {
    extent.extend(sample.Point);
  }
  const char* const sides[3] = { "x", "y", "z" };
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool low = extent.min()[axis] < result.Box.min()[axis] + result.Spacing;
    const bool high = extent.max()[axis] > result.Box.max()[axis] - result.Spacing;
    if (low || high)
    {
      throw Error("visual hull",
        std::string("it reaches the search box at ") + (low ? "min " : "max ") + sides[axis] +
          " = " + std::to_string(low ? result.Box.min()[axis] : result.Box.max()[axis]) +
          ": the silhouettes do not bound the object there, or the box is too small");
    }
  }
}
}

VisualHullResult ComputeVisualHull(
  const std::vector<View>& views, const VisualHullOptions& options, const Execution& execution)
{
  VisualHullResult result;
  const SilhouetteField field(views);
  result.Box = options.Box ? *options.Box : FindSearchBox(views);
  result.Spacing = options.SpacingPx * FootprintAt(views, result.Box.center());
  if (!options.Box)
  {
    // The found box touches the hull; leave room for the test that it does not.
    const Vector3d margin =
      Vector3d::Constant(3 * result.Spacing + 0.01 * result.Box.diagonal().norm());
    result.Box.min() -= margin;
    result.Box.max() += margin;
  }
  Lattice lattice;
  lattice.Spacing = result.Spacing;
  lattice.Origin = result.Box.min();
  for (int axis = 0; axis < 3; ++axis)
  {
    const double blocks = result.Box.sizes()[axis] / (result.Spacing * BlockCells);
    if (!(blocks <= MaxBlocks))
    {
      std::ostringstream cells;
      cells << blocks * BlockCells << " cells along a side";
      throw Error("visual hull", "the search box is too large for the sample spacing", cells.str(),
        "at most a million");
    }
    lattice.Blocks[axis] = std::max(CeilToInt(blocks), 1);
  }
  execution.Report(0.02);
  const std::vector<Vector3i> blocks = SurfaceBlocks(field, lattice, execution);
  execution.Report(0.1);
  std::vector<CellSample> samples = SampleBlocks(field, lattice, blocks, execution);
  if (samples.empty())
  {
    ThrowEmpty(views, result.Box);
  }
  KeepComponents(samples, options.KeepAllComponents, result);
  CheckInsideBox(samples, result);
  result.Samples.Points.reserve(samples.size());
  result.Samples.Normals.reserve(samples.size());
  for (const CellSample& sample : samples)
  {
    result.Samples.Points.push_back(sample.Point);
    result.Samples.Normals.push_back(sample.Normal);
  }
  execution.Report(1);
  return result;
}
}
