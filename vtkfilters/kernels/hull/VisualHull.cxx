// SPDX-License-Identifier: GPL-3.0-or-later
#include "hull/VisualHull.h"

#include "core/Error.h"
#include "core/ToInt.h"
#include "geometry/ViewSelection.h"
#include "hull/HullSampling.h"
#include "hull/SurfaceNets.h"
#include "silhouettes/SearchBox.h"
#include "silhouettes/SilhouetteField.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <string>

namespace novelview
{
namespace
{
using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr int MaxBlocks = 1 << 18; ///< along a side of the lattice

double FootprintAt(const std::vector<View>& views, const Vector3d& at)
{
  const double footprint = MedianFootprint(views, at);
  if (footprint <= 0)
  {
    throw Error("visual hull", "the middle of the search box lies behind every camera");
  }
  return footprint;
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

/** The search box of the options, if they have one that is not empty. */
std::optional<Eigen::AlignedBox3d> GivenBox(const VisualHullOptions& options)
{
  if (!options.Box)
  {
    return {};
  }
  const Eigen::AlignedBox3d box(
    Vector3d::Map(options.Box->data()), Vector3d::Map(options.Box->data() + 3));
  const bool empty = !(box.min().array() < box.max().array()).all();
  return empty ? std::optional<Eigen::AlignedBox3d>() : box;
}

/** A face of a box. */
struct Face
{
  int Axis;
  bool Low;
};

/** The first face that a sample comes closer to than a distance. */
std::optional<Face> FaceNear(
  const std::vector<CellSample>& samples, const Eigen::AlignedBox3d& box, double distance)
{
  Eigen::AlignedBox3d extent;
  for (const CellSample& sample : samples)
  {
    extent.extend(sample.Point);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool low = extent.min()[axis] < box.min()[axis] + distance;
    const bool high = extent.max()[axis] > box.max()[axis] - distance;
    if (low || high)
    {
      return Face{ axis, low };
    }
  }
  return {};
}

/** The frames cut what reaches the box that was found around the silhouettes. */
void CheckInsideBox(const std::vector<CellSample>& samples, const VisualHullResult& result)
{
  const char* const sides[3] = { "x", "y", "z" };
  if (const auto face = FaceNear(samples, result.Box, result.Spacing))
  {
    const double at = (face->Low ? result.Box.min() : result.Box.max())[face->Axis];
    throw Error("visual hull",
      std::string("it reaches the search box at ") + (face->Low ? "min " : "max ") +
        sides[face->Axis] + " = " + std::to_string(at) +
        ": the silhouettes do not bound the object there; give a box that does with --hull-box");
  }
}

/** The lattice of a box, and a block beyond it on every side when the box bounds the hull. */
Lattice LatticeOf(const Eigen::AlignedBox3d& box, double spacing, bool bounding)
{
  Lattice lattice;
  lattice.Spacing = spacing;
  lattice.Origin = box.min() - Vector3d::Constant(bounding ? BlockCells * spacing : 0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double blocks = box.sizes()[axis] / (spacing * BlockCells);
    if (!(blocks <= MaxBlocks))
    {
      std::ostringstream cells;
      cells << blocks * BlockCells << " cells along a side";
      throw Error("visual hull", "the search box is too large for the sample spacing", cells.str(),
        "at most a million");
    }
    lattice.Blocks[axis] = std::max(CeilToInt(blocks), 1) + (bounding ? 2 : 0);
  }
  return lattice;
}
}

VisualHullResult ComputeVisualHull(
  const std::vector<View>& views, const VisualHullOptions& options, const Execution& execution)
{
  VisualHullResult result;
  const std::optional<Eigen::AlignedBox3d> given = GivenBox(options);
  const SilhouetteField field(views, given);
  result.Box = given ? *given : FindSearchBox(views);
  result.Spacing = options.SpacingPx * FootprintAt(views, result.Box.center());
  if (!given)
  {
    // The found box touches the hull; leave room for the test that it does not.
    const Vector3d margin =
      Vector3d::Constant(3 * result.Spacing + 0.01 * result.Box.diagonal().norm());
    result.Box.min() -= margin;
    result.Box.max() += margin;
  }
  const Lattice lattice = LatticeOf(result.Box, result.Spacing, given.has_value());
  execution.Report(0.02);
  const std::vector<Vector3i> blocks = SurfaceBlocks(field, lattice, execution);
  execution.Report(0.1);
  std::vector<CellSample> samples = SampleBlocks(field, lattice, blocks, execution);
  if (samples.empty())
  {
    ThrowEmpty(views, result.Box);
  }
  KeepComponents(samples, options.KeepAllComponents, result);
  if (given)
  {
    // Samples on its faces are exact to a small part of the spacing.
    result.CutByBox = FaceNear(samples, result.Box, 0.01 * result.Spacing).has_value();
  }
  else
  {
    CheckInsideBox(samples, result);
  }
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
