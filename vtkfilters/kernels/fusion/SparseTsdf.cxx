// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion/SparseTsdf.h"

#include "core/ToInt.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
using Eigen::Vector3d;
using Eigen::Vector3i;

/** A number for every block within a million of the origin. */
std::uint64_t KeyOf(const Vector3i& block)
{
  constexpr int bits = 21;
  constexpr int middle = 1 << (bits - 1);
  const auto part = [](int index) { return static_cast<std::uint64_t>(index + middle); };
  return (part(block.z()) << (2 * bits)) | (part(block.y()) << bits) | part(block.x());
}

/** Number of a neighbour in Block::Around. */
int NumberOf(const Vector3i& offset)
{
  return 13 + offset.x() + 3 * offset.y() + 9 * offset.z();
}
}

//------------------------------------------------------------------------------
SparseTsdf::SparseTsdf(const TsdfField& field, const Eigen::AlignedBox3d& bounds,
  const std::vector<Vector3d>& seeds, double spacing, const Execution& execution)
  : Field(field)
  , Bounds(bounds)
  , Origin(seeds.empty() ? Vector3d(Vector3d::Zero()) : seeds.front())
  , Spacing(spacing)
{
  for (const Vector3d& seed : seeds)
  {
    // The eight blocks around the nearest corner of a block.
    const Vector3d at = (seed - this->Origin) / (Side * spacing);
    const Vector3i corner(RoundToInt(at.x()), RoundToInt(at.y()), RoundToInt(at.z()));
    for (int n = 0; n < 8; ++n)
    {
      this->Add(corner - CornerOf(n));
    }
  }
  this->Grow(0, execution);
}

//------------------------------------------------------------------------------
void SparseTsdf::Add(const Vector3i& at)
{
  const int number = this->NumberOfBlocks();
  if (!this->Known.emplace(KeyOf(at), number).second)
  {
    return;
  }
  Block block;
  block.At = at;
  for (int n = 0; n < 27; ++n)
  {
    const auto found = this->Known.find(KeyOf(at + Vector3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)));
    block.Around[n] = found == this->Known.end() ? -1 : found->second;
    if (block.Around[n] >= 0 && n != 13)
    {
      this->Blocks[block.Around[n]].Around[26 - n] = number;
    }
  }
  this->Blocks.push_back(block);
}

//------------------------------------------------------------------------------
void SparseTsdf::Grow(std::size_t done, const Execution& execution)
{
  do
  {
    const std::size_t end = this->Blocks.size();
    execution.ForEach(static_cast<std::int64_t>(end - done),
      [&](std::int64_t i) { this->Sample(this->Blocks[done + i]); });
    done = end;
    // Earlier blocks may have got a neighbour that the surface separates from them.
    std::vector<std::uint8_t> crossed(end);
    execution.ForEach(static_cast<std::int64_t>(end),
      [&](std::int64_t i)
      { crossed[i] = !this->Blocks[i].Crossed && this->Crosses(this->Blocks[i]); });
    for (std::size_t i = 0; i < end; ++i)
    {
      if (crossed[i])
      {
        this->Blocks[i].Crossed = true;
        const Vector3i first = this->Blocks[i].At - Vector3i::Ones();
        for (int n = 0; n < 27; ++n)
        {
          this->Add(first + Vector3i(n % 3, n / 3 % 3, n / 9));
        }
      }
    }
  } while (done < this->Blocks.size());
}

//------------------------------------------------------------------------------
void SparseTsdf::Sample(Block& block) const
{
  for (int row = 0; row < Side * Side; ++row)
  {
    const Vector3i first = Side * block.At + Vector3i(0, row % Side, row / Side);
    const Vector3d origin = this->Origin + this->Spacing * first.cast<double>();
    const Vector3d step = this->Spacing * Vector3d::UnitX();
    TsdfField::LatticeSample samples[Side];
    this->Field.SampleRow(origin, step, Side, samples);
    for (int x = 0; x < Side; ++x)
    {
      const int at = row * Side + x;
      const bool beyond = !this->Bounds.contains(origin + x * step);
      block.Sampled[at] = samples[x].Distance;
      block.Weights[at] = samples[x].Weight;
      block.Outside[at] = beyond ? std::abs(samples[x].Outside) : samples[x].Outside;
      block.Values[at] = std::max(samples[x].Distance, block.Outside[at]);
    }
  }
}

//------------------------------------------------------------------------------
SparseTsdf::Place SparseTsdf::Find(int block, const Vector3i& at) const
{
  const Vector3i over = (at.array() >= Side).cast<int>() - (at.array() < 0).cast<int>();
  const Vector3i inside = at - Side * over;
  return { this->Blocks[block].Around[NumberOf(over)],
    (inside.z() * Side + inside.y()) * Side + inside.x() };
}

//------------------------------------------------------------------------------
bool SparseTsdf::Crosses(const Block& block) const
{
  const bool free = block.Values[0] > 0;
  const auto differs = [free](float value) { return (value > 0) != free; };
  if (std::any_of(block.Values.begin(), block.Values.end(), differs))
  {
    return true;
  }
  for (int n = 0; n < 6 * Side * Side; ++n)
  {
    const int axis = n % 3;
    Vector3i at;
    at[axis] = n / 3 % 2 ? Side : -1;
    at[(axis + 1) % 3] = n / 6 % Side;
    at[(axis + 2) % 3] = n / 6 / Side;
    const Place place = this->Find(block.Around[13], at);
    if (place.Block >= 0 && differs(this->Blocks[place.Block].Values[place.Point]))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
void SparseTsdf::Laplacian(const Values& values, int block, std::array<float, Size>& sums) const
{
  constexpr int wide = Side + 2; // with a layer of the neighbours' points around
  std::array<float, wide * wide * wide> padded;
  const std::array<float, Size>& own = values[block];
  const auto offset = [](int x, int y, int z) { return ((z + 1) * wide + y + 1) * wide + x + 1; };
  for (int row = 0; row < Side * Side; ++row)
  {
    std::copy_n(&own[Side * row], Side, &padded[offset(0, row % Side, row / Side)]);
  }
  for (int side = 0; side < 6; ++side)
  {
    const int axis = side / 2;
    const int sign = side % 2 ? 1 : -1;
    const int neighbour = this->Blocks[block].Around[NumberOf(sign * Vector3i::Unit(axis))];
    for (int n = 0; n < Side * Side; ++n)
    {
      Vector3i at;
      at[axis] = sign > 0 ? Side - 1 : 0;
      at[(axis + 1) % 3] = n % Side;
      at[(axis + 2) % 3] = n / Side;
      const Vector3i to = at + sign * Vector3i::Unit(axis);
      // What is not stored has no slope.
      at[axis] = neighbour >= 0 ? Side - 1 - at[axis] : at[axis];
      const std::array<float, Size>& from = neighbour >= 0 ? values[neighbour] : own;
      padded[offset(to.x(), to.y(), to.z())] = from[(at.z() * Side + at.y()) * Side + at.x()];
    }
  }
  for (int n = 0; n < Size; ++n)
  {
    const float* at = &padded[offset(n % Side, n / Side % Side, n / (Side * Side))];
    sums[n] = at[-1] + at[1] + at[-wide] + at[wide] + at[-wide * wide] + at[wide * wide] - 6 * *at;
  }
}

//------------------------------------------------------------------------------
void SparseTsdf::Smooth(double lambda, int iterations, const Execution& execution)
{
  constexpr float damping = 0.5F;
  constexpr float diagonal = 42; // of the squared Laplacian: 6^2 + 6
  const auto weight = static_cast<float>(lambda);
  Values values;
  for (const Block& block : this->Blocks)
  {
    values.push_back(block.Values);
  }
  Values curvatures(values.size());
  const auto each = [&](const auto& body) {
    execution.ForEach(this->NumberOfBlocks(), [&](std::int64_t i) { body(static_cast<int>(i)); });
  };
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    each([&](int i) { this->Laplacian(values, i, curvatures[i]); });
    each(
      [&](int i)
      {
        std::array<float, Size> bends;
        this->Laplacian(curvatures, i, bends);
        const Block& block = this->Blocks[i];
        for (int n = 0; n < Size; ++n)
        {
          const float slope =
            block.Weights[n] * (block.Sampled[n] - values[i][n]) - weight * bends[n];
          const float step = damping * slope / (block.Weights[n] + diagonal * weight);
          values[i][n] = std::max(values[i][n] + step, block.Outside[n]);
        }
      });
  }
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    this->Blocks[i].Values = values[i];
  }
  this->Grow(this->Blocks.size(), execution);
}

//------------------------------------------------------------------------------
bool SparseTsdf::Cell(int block, int point, std::array<float, 8>& values) const
{
  for (int corner = 0; corner < 8; ++corner)
  {
    const Place place = this->Find(block, PointOf(point) + CornerOf(corner));
    if (place.Block < 0)
    {
      return false;
    }
    values[corner] = this->Blocks[place.Block].Values[place.Point];
  }
  return true;
}
}
