// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo/NeighbourMatching.h"

#include "stereo/ReferenceRows.h"

#include <algorithm>
#include <cstdint>

namespace novelview
{
namespace
{
/** Puts costs in their places among the least so far of each pixel. */
void KeepLeast(std::vector<std::vector<std::int16_t>>& ranks, std::vector<std::int16_t>& costs)
{
  for (auto& rank : ranks)
  {
    std::int16_t* kept = rank.data();
    std::int16_t* cost = costs.data();
#pragma GCC ivdep
    for (std::size_t x = 0; x < costs.size(); ++x)
    {
      const std::int16_t smaller = std::min(kept[x], cost[x]);
      cost[x] = static_cast<std::int16_t>(kept[x] + cost[x] - smaller); // the larger
      kept[x] = smaller;
    }
  }
}

/** Rounded means over the ranks. */
void MeanOfRanks(
  const std::vector<std::vector<std::int16_t>>& ranks, std::vector<float>& sums, std::int16_t* out)
{
  std::fill(sums.begin(), sums.end(), 0.5f);
  const float share = 1 / static_cast<float>(ranks.size());
  for (const auto& rank : ranks)
  {
    for (std::size_t x = 0; x < sums.size(); ++x)
    {
      sums[x] += share * static_cast<float>(rank[x]);
    }
  }
  for (std::size_t x = 0; x < sums.size(); ++x)
  {
    out[x] = static_cast<std::int16_t>(static_cast<std::int32_t>(sums[x]));
  }
}

/** Fills one label of the volume; all neighbours side by side, so that only rows are held. */
void MatchAtLabel(int label, std::vector<PlaneSweepCost>& sweeps,
  std::vector<std::vector<std::int16_t>>& ranks, int radius, CostVolume& volume)
{
  std::vector<std::int16_t> costs(volume.Box.Width());
  std::vector<float> sums(volume.Box.Width());
  for (PlaneSweepCost& sweep : sweeps)
  {
    sweep.Start(volume.Labels.Offset(label));
  }
  for (int y = -radius; y < volume.Box.Height() + radius; ++y)
  {
    bool any = false;
    for (auto& rank : ranks)
    {
      std::fill(rank.begin(), rank.end(), CostVolume::Unit);
    }
    for (PlaneSweepCost& sweep : sweeps)
    {
      sweep.Enter(y);
      if (y >= radius)
      {
        std::fill(costs.begin(), costs.end(), CostVolume::Unit);
        if (sweep.Costs(costs.data()))
        {
          KeepLeast(ranks, costs);
          any = true;
        }
      }
    }
    if (any)
    {
      MeanOfRanks(ranks, sums, volume.Row(y - radius, label));
    }
  }
}
}

PixelBox BoxOfBase(const Image<float>& base)
{
  PixelBox box{ base.Width, 0, base.Height, 0 };
  for (int y = 0; y < base.Height; ++y)
  {
    for (int x = 0; x < base.Width; ++x)
    {
      if (base(x, y) > 0)
      {
        box = { std::min(box.XBegin, x), std::max(box.XEnd, x + 1), std::min(box.YBegin, y),
          std::max(box.YEnd, y + 1) };
      }
    }
  }
  return box;
}

CostVolume MatchNeighbours(const MatchImage& reference, const Image<float>& base,
  const Image<float>& last, const std::vector<const MatchImage*>& neighbours, const PixelBox& box,
  const DepthHypotheses& labels, const MatchOptions& options, const Execution& execution)
{
  CostVolume volume;
  volume.Box = box;
  volume.Labels = labels;
  const int width = box.Width();
  const int height = box.Height();
  volume.Costs.assign(static_cast<std::size_t>(width) * height * labels.Count, CostVolume::Unit);
  const std::size_t best = std::min<std::size_t>(options.BestNeighbours, neighbours.size());
  if (best == 0)
  {
    return volume;
  }
  const ReferenceRows rows(reference, base, last, box, options.WindowRadius);
  std::vector<PlaneSweepCost> sweeps;
  sweeps.reserve(neighbours.size());
  for (const MatchImage* other : neighbours)
  {
    sweeps.emplace_back(rows, *other, options);
  }
  std::vector<std::vector<std::int16_t>> ranks(best, std::vector<std::int16_t>(width));
  for (int label = 0; label < labels.Count; ++label)
  {
    execution.CheckCancelled();
    MatchAtLabel(label, sweeps, ranks, options.WindowRadius, volume);
  }
  return volume;
}
}
