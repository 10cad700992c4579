// SPDX-License-Identifier: GPL-3.0-or-later
#include "MatchingVolume.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace novelview
{
namespace
{
/** The path costs of one row of pixels: labels x width, and the least per pixel. */
struct PathRow
{
  PathRow(int labels, int width)
    : Width(width)
    , Costs(static_cast<std::size_t>(labels) * width, 0.f)
    , Least(width, 0.f)
  {
  }
  float* Of(int label)
  {
    return this->Costs.data() + static_cast<std::size_t>(label) * this->Width;
  }

  int Width;
  std::vector<float> Costs;
  std::vector<float> Least;
};

/** What all directions share. */
class Aggregator
{
public:
  Aggregator(
    const MatchingVolume& volume, const Image<float>& base, const SemiGlobalOptions& options)
    : Volume(volume)
    , Base(base)
    , P1(static_cast<float>(options.StepPenalty))
    , P2(static_cast<float>(options.JumpPenalty))
    , Width(volume.Box.Width())
    , Height(volume.Box.Height())
    , Labels(volume.Labels.Count)
    , Sum(volume.Costs.size(), 0.f)
  {
  }

  std::vector<float> Run()
  {
    for (const int dy : { 1, -1 })
    {
      for (int dx = -1; dx <= 1; ++dx)
      {
        this->AlongRows(dx, dy);
      }
    }
    for (int y = 0; y < this->Height; ++y)
    {
      this->AlongColumns(y, 1);
      this->AlongColumns(y, -1);
    }
    return std::move(this->Sum);
  }

private:
  bool Takes(int x, int y) const
  {
    return this->Base(this->Volume.Box.X0 + x, this->Volume.Box.Y0 + y) > 0;
  }
  float* SumRow(int y, int label)
  {
    return this->Sum.data() + (static_cast<std::size_t>(y) * this->Labels + label) * this->Width;
  }

  /** Paths that come from (x - dx, y - dy), dy not 0: a row at a time, all pixels side by side. */
  void AlongRows(int dx, int dy)
  {
    PathRow before(this->Labels, this->Width + 2); // a margin on both sides, always 0
    PathRow now(this->Labels, this->Width + 2);
    for (int n = 0; n < this->Height; ++n)
    {
      const int y = dy > 0 ? n : this->Height - 1 - n;
      const float* least = before.Least.data() + 1 - dx;
      for (int label = 0; label < this->Labels; ++label)
      {
        const float* same = before.Of(label) + 1 - dx;
        const float* down = before.Of(std::max(label - 1, 0)) + 1 - dx;
        const float* up = before.Of(std::min(label + 1, this->Labels - 1)) + 1 - dx;
        const float* cost = this->Volume.Row(y, label);
        float* out = now.Of(label) + 1;
        float* sum = this->SumRow(y, label);
        for (int x = 0; x < this->Width; ++x)
        {
          const float step = std::min(down[x], up[x]) + this->P1;
          const float jump = least[x] + this->P2;
          out[x] = cost[x] + std::min(std::min(same[x], step), jump) - least[x];
          sum[x] += out[x];
        }
      }
      this->FinishRow(y, now);
      std::swap(before, now);
    }
  }

  /** Least path cost per pixel; paths begin anew at pixels that take no part. */
  void FinishRow(int y, PathRow& row) const
  {
    float* least = row.Least.data() + 1;
    std::copy_n(row.Of(0) + 1, this->Width, least);
    for (int label = 1; label < this->Labels; ++label)
    {
      const float* costs = row.Of(label) + 1;
      for (int x = 0; x < this->Width; ++x)
      {
        least[x] = std::min(least[x], costs[x]);
      }
    }
    for (int x = 0; x < this->Width; ++x)
    {
      if (!this->Takes(x, y))
      {
        least[x] = 0;
        for (int label = 0; label < this->Labels; ++label)
        {
          row.Of(label)[x + 1] = 0;
        }
      }
    }
  }

  /** Paths within a row, from the left (dx = 1) or from the right (dx = -1). */
  void AlongColumns(int y, int dx)
  {
    std::vector<float> before(this->Labels, 0.f);
    std::vector<float> now(this->Labels);
    float least = 0;
    for (int n = 0; n < this->Width; ++n)
    {
      const int x = dx > 0 ? n : this->Width - 1 - n;
      if (!this->Takes(x, y))
      {
        std::fill(before.begin(), before.end(), 0.f);
        least = 0;
        continue;
      }
      float nextLeast = std::numeric_limits<float>::max();
      for (int label = 0; label < this->Labels; ++label)
      {
        const float down = before[std::max(label - 1, 0)];
        const float up = before[std::min(label + 1, this->Labels - 1)];
        const float step = std::min(down, up) + this->P1;
        const float reached = std::min(std::min(before[label], step), least + this->P2);
        now[label] = this->Volume.Row(y, label)[x] + reached - least;
        nextLeast = std::min(nextLeast, now[label]);
        this->SumRow(y, label)[x] += now[label];
      }
      least = nextLeast;
      std::swap(before, now);
    }
  }

  const MatchingVolume& Volume;
  const Image<float>& Base;
  const float P1;
  const float P2;
  const int Width;
  const int Height;
  const int Labels;
  std::vector<float> Sum;
};
}

MatchingVolume AggregateSemiGlobally(
  const MatchingVolume& volume, const Image<float>& base, const SemiGlobalOptions& options)
{
  return { volume.Box, volume.Labels, Aggregator(volume, base, options).Run() };
}

Image<float> WinningDepth(
  const MatchingVolume& aggregated, const Image<float>& base, Image<std::uint8_t>& winner)
{
  Image<float> depth(base.Width, base.Height);
  winner = Image<std::uint8_t>(base.Width, base.Height);
  const PixelBox& box = aggregated.Box;
  const int labels = aggregated.Labels.Count;
  for (int y = 0; y < box.Height(); ++y)
  {
    for (int x = 0; x < box.Width(); ++x)
    {
      const float start = base(box.X0 + x, box.Y0 + y);
      if (start <= 0)
      {
        continue;
      }
      int best = 0;
      for (int label = 1; label < labels; ++label)
      {
        if (aggregated.Row(y, label)[x] < aggregated.Row(y, best)[x])
        {
          best = label;
        }
      }
      double refined = best;
      if (best > 0 && best < labels - 1)
      {
        const double below = aggregated.Row(y, best - 1)[x];
        const double here = aggregated.Row(y, best)[x];
        const double above = aggregated.Row(y, best + 1)[x];
        const double curvature = below - 2 * here + above;
        refined += curvature > 0 ? 0.5 * (below - above) / curvature : 0;
      }
      winner(box.X0 + x, box.Y0 + y) = static_cast<std::uint8_t>(best);
      depth(box.X0 + x, box.Y0 + y) = static_cast<float>(start + aggregated.Labels.Offset(refined));
    }
  }
  return depth;
}
}
