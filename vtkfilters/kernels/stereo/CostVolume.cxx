// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo/CostVolume.h"

#include "stereo/PlaneSweepCost.h"

#include <algorithm>

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

MatchImage MakeMatchImage(const View& view, int reduction)
{
  MatchImage image;
  image.Cam = view.Cam;
  image.Cam.Width = view.Cam.Width / reduction;
  image.Cam.Height = view.Cam.Height / reduction;
  image.Cam.K.topRows<2>() /= reduction;
  // The small pixel x covers reduction pixels whose middle is reduction x + (reduction - 1) / 2.
  image.Cam.K(0, 2) -= 0.5 * (reduction - 1) / reduction;
  image.Cam.K(1, 2) -= 0.5 * (reduction - 1) / reduction;
  image.Pixels = Image<std::uint8_t>(image.Cam.Width, image.Cam.Height, 4);
  for (int y = 0; y < image.Cam.Height; ++y)
  {
    for (int x = 0; x < image.Cam.Width; ++x)
    {
      int count = 0;
      int sum[3] = { 0, 0, 0 };
      for (int n = 0; n < reduction * reduction; ++n)
      {
        const int i = x * reduction + n % reduction;
        const int j = y * reduction + n / reduction;
        if (view.IsObject(i, j))
        {
          ++count;
          for (int channel = 0; channel < 3; ++channel)
          {
            sum[channel] += view.Color(i, j, channel);
          }
        }
      }
      if (2 * count < reduction * reduction || count == 0)
      {
        continue;
      }
      int rgb[3];
      for (int channel = 0; channel < 3; ++channel)
      {
        rgb[channel] = (sum[channel] + count / 2) / count;
        image.Pixels(x, y, channel) = static_cast<std::uint8_t>(rgb[channel]);
      }
      const int luma = (299 * rgb[0] + 587 * rgb[1] + 114 * rgb[2] + 500) / 1000;
      image.Pixels(x, y, 3) = static_cast<std::uint8_t>(std::max(luma, 1));
    }
  }
  return image;
}

PixelBox BoxOfBase(const Image<float>& base)
{
  PixelBox box{ base.Width, base.Height, -1, -1 };
  for (int y = 0; y < base.Height; ++y)
  {
    for (int x = 0; x < base.Width; ++x)
    {
      if (base(x, y) > 0)
      {
        box = { std::min(box.X0, x), std::min(box.Y0, y), std::max(box.X1, x),
          std::max(box.Y1, y) };
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
