// SPDX-License-Identifier: GPL-3.0-or-later
#include "VisualHull.h"

#include "DisjointSets.h"
#include "SearchBox.h"
#include "SilhouetteField.h"
#include "ViewSelection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace novelview
{
namespace
{
using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr int BlockCells = 4;           ///< lattice cells along a block's side
constexpr int Corners = BlockCells + 1; ///< lattice points along a block's side

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

struct CellSample
{
  Vector3i Cell;
  Vector3d Point;
  Vector3d Normal;
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
  for (int step = 1; a.Value > tolerance && (b.Point - a.Point).norm() > tolerance; ++step)
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

/** A number that orders cells by z, then y, then x; also for those one outside the lattice. */
std::uint64_t KeyOf(const Vector3i& cell)
{
  return (static_cast<std::uint64_t>(cell.z() + 1) << 42) |
    (static_cast<std::uint64_t>(cell.y() + 1) << 21) | static_cast<std::uint64_t>(cell.x() + 1);
}

/** Keys and places of the samples, ascending. */
using SortedCells = std::vector<std::pair<std::uint64_t, int>>;

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

/** Component number per sample; cells that touch (26 neighbours) are connected. */
class ComponentFinder
{
public:
  ComponentFinder(const std::vector<CellSample>& samples, const SortedCells& cells)
    : Sets(static_cast<int>(samples.size()))
  {
    for (const auto& [key, sampleId] : cells)
    {
      this->ConnectForward(samples[sampleId].Cell, sampleId, cells);
    }
  }

  int Root(int i) { return this->Sets.Find(i); }

private:
  void ConnectForward(const Vector3i& cell, int sampleId, const SortedCells& keys)
  {
    for (int dz = 0; dz <= 1; ++dz)
    {
      for (int dy = dz ? -1 : 0; dy <= 1; ++dy)
      {
        // Three neighbours in x have consecutive keys.
        const int dx = dz || dy ? -1 : 1;
        const std::uint64_t low = KeyOf(cell + Vector3i(dx, dy, dz));
        const std::uint64_t high = KeyOf(cell + Vector3i(1, dy, dz));
        auto it = std::lower_bound(keys.begin(), keys.end(), std::make_pair(low, -1));
        for (; it != keys.end() && it->first <= high; ++it)
        {
          this->Sets.Unite(sampleId, it->second);
        }
      }
    }
  }

  DisjointSets Sets;
};

/**
 * Samples of like normals are this far apart at least, in spacings. Where the surface runs along the
 * lattice they are a whole spacing apart anyway.
 */
constexpr double LeastDistance = 0.7;

/** Normals are alike up to 60 degrees: the two sides of a thin sheet are not. */
constexpr double LikeCosine = 0.5;

/**
 * Which samples stay when, in the order of their cells, each that is too close to one that stays is
 * left out. Cells on a slope lie closer together than the spacing, and what they add to the crust's
 * cost they do not add to its shape.
 */
std::vector<char> ThinOut(
  const std::vector<CellSample>& samples, const SortedCells& cells, double spacing)
{
  const double least = LeastDistance * spacing;
  const auto tooClose = [&](const CellSample& a, const CellSample& b)
  {
    return (a.Point - b.Point).squaredNorm() < least * least && a.Normal.dot(b.Normal) > LikeCosine;
  };
  // The neighbours that come before a cell lie in five rows; each has a place that only advances.
  const Vector3i rows[5] = { { -1, -1, -1 }, { -1, 0, -1 }, { -1, 1, -1 }, { -1, -1, 0 },
    { -1, 0, 0 } };
  std::size_t begins[5] = {};
  std::vector<char> stays(samples.size(), 1);
  for (const auto& [key, sampleId] : cells)
  {
    const CellSample& sample = samples[sampleId];
    for (int row = 0; row < 5; ++row)
    {
      const std::uint64_t low = KeyOf(sample.Cell + rows[row]);
      while (cells[begins[row]].first < low)
      {
        ++begins[row];
      }
      for (std::size_t i = begins[row]; cells[i].first <= low + 2 && cells[i].first < key; ++i)
      {
        const int other = cells[i].second;
        stays[sampleId] &= !(stays[other] && tooClose(samples[other], sample));
      }
    }
  }
  return stays;
}

/** Leaves the samples that `stays` marks, of all components or of the largest. */
void KeepComponents(std::vector<CellSample>& samples, const SortedCells& cells,
  const std::vector<char>& stays, bool keepAll, VisualHullResult& result)
{
  ComponentFinder components(samples, cells);
  std::vector<std::size_t> sizes(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    ++sizes[components.Root(static_cast<int>(i))];
  }
  result.Components = static_cast<int>(
    std::count_if(sizes.begin(), sizes.end(), [](std::size_t size) { return size > 0; }));
  const int largest =
    static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  std::vector<CellSample> kept;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    const bool wanted = keepAll || components.Root(static_cast<int>(i)) == largest;
    if (stays[i] && wanted)
    {
      kept.push_back(samples[i]);
    }
    result.DroppedSamples += stays[i] && !wanted;
  }
  result.DroppedComponents = keepAll ? 0 : result.Components - 1;
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
      const Vector3d at((n % steps) + 0.5, (n / steps) % steps + 0.5, n / (steps * steps) + 0.5);
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
  lattice.Blocks =
    (result.Box.sizes() / (result.Spacing * BlockCells)).array().ceil().cast<int>().max(1);
  if (lattice.Blocks.maxCoeff() > 1 << 18)
  {
    throw Error("visual hull", "the search box is too large for the sample spacing",
      std::to_string(lattice.Blocks.maxCoeff() * BlockCells) + " cells along a side",
      "at most a million");
  }
  execution.Report(0.02);
  const std::vector<Vector3i> blocks = SurfaceBlocks(field, lattice, execution);
  execution.Report(0.1);
  std::vector<CellSample> samples = SampleBlocks(field, lattice, blocks, execution);
  if (samples.empty())
  {
    ThrowEmpty(views, result.Box);
  }
  const SortedCells cells = SortCells(samples);
  KeepComponents(
    samples, cells, ThinOut(samples, cells, result.Spacing), options.KeepAllComponents, result);
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
