// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo/SemiGlobal.h"

#include "core/FunctionMultiversioning.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
using Cost = std::int16_t;

/** More than any path costs, and far from overflow. */
constexpr Cost Unreachable = 8 * CostVolume::Unit;

/** A penalty in units of cost; what is cut off is far above the cost of any jump. */
Cost PenaltyOf(double penalty)
{
  return static_cast<Cost>(std::lround(std::clamp(penalty, 0.0, 2.5) * CostVolume::Unit));
}

/** The path costs of one row of pixels: labels x width, and the least per pixel. */
struct PathRow
{
  PathRow(int labels, int width)
    : Width(width)
    , Costs(static_cast<std::size_t>(labels) * width, 0)
    , Min(width, 0)
  {
  }
  Cost* Of(int label) { return this->Costs.data() + static_cast<std::size_t>(label) * this->Width; }

  int Width;
  std::vector<Cost> Costs;
  std::vector<Cost> Min;
};

/** One label of a row: what comes from the pixels that the paths come from. */
struct Arrivals
{
  const Cost* Same;
  const Cost* Down;
  const Cost* Up;
  const Cost* Min;
};

/** Goes one pixel further; the loops over a row are plain so that the compiler does many at once. */
NOVELVIEW_CLONES void Advance(const Arrivals& from, const Cost* __restrict cost,
  const Cost* __restrict mask, Cost p1, Cost p2, int width, Cost* __restrict out,
  Cost* __restrict least, Cost* __restrict sum)
{
  for (int x = 0; x < width; ++x)
  {
    const Cost step = static_cast<Cost>(std::min(from.Down[x], from.Up[x]) + p1);
    const Cost jump = static_cast<Cost>(from.Min[x] + p2);
    const Cost reached = std::min(std::min(from.Same[x], step), jump);
    const Cost path = static_cast<Cost>((cost[x] + reached - from.Min[x]) & mask[x]);
    out[x] = path;
    least[x] = std::min(least[x], path);
    sum[x] = static_cast<Cost>(sum[x] + path);
  }
}

/** The same along a row: one pixel, all labels. `before` and `out` have a place on both sides. */
NOVELVIEW_CLONES Cost AdvanceLabels(const Cost* __restrict before, const Cost* __restrict cost,
  Cost least, Cost p1, Cost p2, int labels, Cost* __restrict out, Cost* __restrict sum)
{
  const Cost jump = static_cast<Cost>(least + p2);
  Cost nextMin = Unreachable;
  for (int label = 0; label < labels; ++label)
  {
    const Cost step = static_cast<Cost>(std::min(before[label - 1], before[label + 1]) + p1);
    const Cost reached = std::min(std::min(before[label], step), jump);
    const Cost path = static_cast<Cost>(cost[label] + reached - least);
    out[label] = path;
    nextMin = std::min(nextMin, path);
    sum[label] = static_cast<Cost>(sum[label] + path);
  }
  return nextMin;
}

/** What all directions share. */
class Aggregator
{
public:
  Aggregator(const CostVolume& volume, const Image<float>& base, const SemiGlobalOptions& options,
    const Execution& execution)
    : Volume(volume)
    , Execute(execution)
    , Base(base)
    , P1(PenaltyOf(options.P1))
    , P2(PenaltyOf(options.P2))
    , Width(volume.Box.Width())
    , Height(volume.Box.Height())
    , Labels(volume.Labels.Count)
    , Sums{ volume.Box, volume.Labels, std::vector<Cost>(volume.Costs.size(), 0) }
    , Mask(this->Width)
    , CostsOfPixels(volume.Costs.size() / std::max(this->Height, 1))
    , SumsOfPixels(this->CostsOfPixels.size())
  {
  }

  CostVolume Run()
  {
    this->AlongRows(1);
    this->AlongRows(-1);
    return std::move(this->Sums);
  }

private:
  /** Sets the mask of a row: all bits where the pixel takes part. */
  void ReadMask(int y)
  {
    for (int x = 0; x < this->Width; ++x)
    {
      this->Mask[x] =
        this->Base(this->Volume.Box.XBegin + x, this->Volume.Box.YBegin + y) > 0 ? -1 : 0;
    }
  }

  /**
   * The three directions that come from the row before (dy = 1: from above), all pixels side by
   * side; on the way down also those within the row. Paths begin anew at pixels that take no part.
   */
  void AlongRows(int dy)
  {
    // A margin on both sides, always 0.
    std::vector<PathRow> before(3, PathRow(this->Labels, this->Width + 2));
    std::vector<PathRow> now = before;
    for (int n = 0; n < this->Height; ++n)
    {
      this->Execute.CheckCancelled();
      const int y = dy > 0 ? n : this->Height - 1 - n;
      this->ReadMask(y);
      for (PathRow& row : now)
      {
        std::fill_n(row.Min.begin() + 1, this->Width, Unreachable);
      }
      for (int label = 0; label < this->Labels; ++label)
      {
        for (int dx = -1; dx <= 1; ++dx)
        {
          PathRow& from = before[dx + 1];
          PathRow& to = now[dx + 1];
          const Arrivals arrivals{ from.Of(label) + 1 - dx,
            from.Of(std::max(label - 1, 0)) + 1 - dx,
            from.Of(std::min(label + 1, this->Labels - 1)) + 1 - dx, from.Min.data() + 1 - dx };
          Advance(arrivals, this->Volume.Row(y, label), this->Mask.data(), this->P1, this->P2,
            this->Width, to.Of(label) + 1, to.Min.data() + 1, this->Sums.Row(y, label));
        }
      }
      std::swap(before, now);
      if (dy > 0)
      {
        this->WithinRow(y);
      }
    }
  }

  /** Paths from the left and from the right; a pixel's labels side by side. */
  void WithinRow(int y)
  {
    for (int label = 0; label < this->Labels; ++label)
    {
      const Cost* row = this->Volume.Row(y, label);
      for (int x = 0; x < this->Width; ++x)
      {
        this->CostsOfPixels[static_cast<std::size_t>(x) * this->Labels + label] = row[x];
      }
    }
    std::fill(this->SumsOfPixels.begin(), this->SumsOfPixels.end(), 0);
    this->FromOneSide(1);
    this->FromOneSide(-1);
    for (int label = 0; label < this->Labels; ++label)
    {
      Cost* row = this->Sums.Row(y, label);
      for (int x = 0; x < this->Width; ++x)
      {
        row[x] = static_cast<Cost>(
          row[x] + this->SumsOfPixels[static_cast<std::size_t>(x) * this->Labels + label]);
      }
    }
  }

  void FromOneSide(int dx)
  {
    std::vector<Cost> before(this->Labels + 2, 0);
    before.front() = before.back() = Unreachable;
    std::vector<Cost> now = before;
    Cost least = 0;
    for (int n = 0; n < this->Width; ++n)
    {
      const int x = dx > 0 ? n : this->Width - 1 - n;
      if (this->Mask[x] == 0)
      {
        std::fill_n(before.begin() + 1, this->Labels, 0);
        least = 0;
        continue;
      }
      const std::size_t first = static_cast<std::size_t>(x) * this->Labels;
      least = AdvanceLabels(before.data() + 1, this->CostsOfPixels.data() + first, least, this->P1,
        this->P2, this->Labels, now.data() + 1, this->SumsOfPixels.data() + first);
      std::swap(before, now);
    }
  }

  const CostVolume& Volume;
  const Execution& Execute;
  const Image<float>& Base;
  const Cost P1;
  const Cost P2;
  const int Width;
  const int Height;
  const int Labels;
  CostVolume Sums;
  std::vector<Cost> Mask;
  std::vector<Cost> CostsOfPixels; ///< of one row, a pixel's labels side by side
  std::vector<Cost> SumsOfPixels;
};
}

CostVolume AggregateSemiGlobally(const CostVolume& volume, const Image<float>& base,
  const SemiGlobalOptions& options, const Execution& execution)
{
  return Aggregator(volume, base, options, execution).Run();
}

Image<float> WinnerTakesAll(
  const CostVolume& aggregated, const Image<float>& base, Image<std::uint8_t>& winner)
{
  Image<float> depth(base.Width, base.Height);
  winner = Image<std::uint8_t>(base.Width, base.Height);
  const PixelBox& box = aggregated.Box;
  const int labels = aggregated.Labels.Count;
  for (int y = 0; y < box.Height(); ++y)
  {
    for (int x = 0; x < box.Width(); ++x)
    {
      const float start = base(box.XBegin + x, box.YBegin + y);
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
      winner(box.XBegin + x, box.YBegin + y) = static_cast<std::uint8_t>(best);
      depth(box.XBegin + x, box.YBegin + y) =
        static_cast<float>(start + aggregated.Labels.Offset(refined));
    }
  }
  return depth;
}
}
