// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo/RowLoops.h"

#include "core/FunctionMultiversioning.h"
#include "stereo/CostVolume.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
NOVELVIEW_CLONES void ProjectColumns(
  RayRow row, RayWay way, float offset, std::int32_t width, std::int32_t height, int begin, int end)
{
  const float maxX = static_cast<float>(width - 1);
  const float maxY = static_cast<float>(height - 1);
#pragma GCC ivdep
  for (int i = begin; i < end; ++i)
  {
    const float column = static_cast<float>(i);
    const float depth = row.Base[i] + offset;
    const float px = (way.Slope[0] * column + way.Start[0]) * depth + way.End[0];
    const float py = (way.Slope[1] * column + way.Start[1]) * depth + way.End[1];
    const float pz = (way.Slope[2] * column + way.Start[2]) * depth + way.End[2];
    const float x = px / pz;
    const float y = py / pz;
    const bool meets = (row.Base[i] > 0) & (offset <= row.Last[i]) & (pz > 0) & (x >= 0) &
      (y >= 0) & (x < maxX) & (y < maxY);
    // Not a number, which is no less than 0 and no more, becomes 0.
    const float safeX = std::min(std::max(0.f, x), maxX);
    const float safeY = std::min(std::max(0.f, y), maxY);
    const auto x0 = static_cast<std::int32_t>(safeX);
    const auto y0 = static_cast<std::int32_t>(safeY);
    const float fx = safeX - static_cast<float>(x0);
    const float fy = safeY - static_cast<float>(y0);
    const std::int32_t pixel = y0 * width + x0;
    const std::int32_t near = pixel + (fx >= 0.5f ? 1 : 0) + (fy >= 0.5f ? width : 0);
    row.First[i] = pixel;
    row.Nearest[i] = near | (static_cast<std::int32_t>(meets) - 1);
    row.Down[i] = static_cast<std::int32_t>(fy * 128);
    row.Right[i] = fx;
  }
}

NOVELVIEW_CLONES void CompareColumns(PairRow row, float levelsPerGrey, int begin, int end)
{
  constexpr float unit = 1.f / 128;
#pragma GCC ivdep
  for (int i = begin; i < end; ++i)
  {
    const std::int32_t both = row.Nearest[i] < 0 ? 0 : 255;
    const float r = static_cast<float>(row.Red[i]) - unit * row.Picked[4 * i];
    const float g = static_cast<float>(row.Green[i]) - unit * row.Picked[4 * i + 1];
    const float b = static_cast<float>(row.Blue[i]) - unit * row.Picked[4 * i + 2];
    const float levels = std::sqrt(r * r + g * g + b * b) * levelsPerGrey + 0.5f;
    const auto luma = static_cast<std::int32_t>(unit * row.Picked[4 * i + 3] + 0.5f);
    row.Count[i] = static_cast<std::uint8_t>(both & 1);
    row.KeyLuma[i] = static_cast<std::uint8_t>(row.Luma[i] & both);
    row.OtherLuma[i] = static_cast<std::uint8_t>(luma & both);
    row.Difference[i] =
      static_cast<std::uint8_t>(static_cast<std::int32_t>(std::min(levels, 255.f)) & both);
  }
}

NOVELVIEW_CLONES void AddChange(std::uint16_t* __restrict sums,
  const std::uint8_t* __restrict entering, const std::uint8_t* __restrict leaving, int begin,
  int end)
{
  for (int i = begin; i < end; ++i)
  {
    sums[i] = static_cast<std::uint16_t>(sums[i] + entering[i] - leaving[i]);
  }
}

NOVELVIEW_CLONES void AddChange(std::int32_t* __restrict sums,
  const std::uint8_t* __restrict enteringA, const std::uint8_t* __restrict enteringB,
  const std::uint8_t* __restrict leavingA, const std::uint8_t* __restrict leavingB, int begin,
  int end)
{
  for (int i = begin; i < end; ++i)
  {
    const auto entering = static_cast<std::uint16_t>(enteringA[i] * enteringB[i]);
    const auto leaving = static_cast<std::uint16_t>(leavingA[i] * leavingB[i]);
    sums[i] += entering - leaving;
  }
}

namespace
{
/** Sum over the window's columns; KnownSide = 0 if it is known only when the program runs. */
template <int KnownSide, class T>
[[gnu::always_inline]] inline T AcrossWindow(const T* columns, int side)
{
  T sum = columns[0];
  for (int k = 1; k < (KnownSide ? KnownSide : side); ++k)
  {
    sum = static_cast<T>(sum + columns[k]);
  }
  return sum;
}

template <int KnownSide>
[[gnu::always_inline]] inline void CostsAtSide(const ColumnSums& sums, const CostRule& rule,
  int side, int begin, int end, std::int16_t* __restrict costs)
{
  constexpr float unit = CostVolume::Unit;
  for (int i = begin; i < end; ++i)
  {
    const auto across = [&](const auto* columns)
    { return static_cast<float>(AcrossWindow<KnownSide>(columns + i, side)); };
    const float n = across(sums.Count);
    const float reference = across(sums.Reference);
    const float other = across(sums.Other);
    const float noise = rule.Noise * n * n;
    const float varianceKey = n * across(sums.Reference2) - reference * reference + noise;
    const float varianceOther = n * across(sums.Other2) - other * other + noise;
    const float covariance = n * across(sums.Product) - reference * other;
    const float correlation = std::max(covariance, 0.f) / std::sqrt(varianceKey * varianceOther);
    const float difference = across(sums.Difference) / (255 * n);
    const float cost =
      (1 - rule.ShareOfColor) * 0.5f * (1 - correlation) + rule.ShareOfColor * difference;
    costs[i] = static_cast<std::int16_t>(
      static_cast<std::int32_t>(n < rule.MinCount ? unit : unit * cost + 0.5f));
  }
}
}

NOVELVIEW_CLONES void CostsOfColumns(
  const ColumnSums& sums, const CostRule& rule, int side, int begin, int end, std::int16_t* costs)
{
  if (side == 5)
  {
    CostsAtSide<5>(sums, rule, side, begin, end, costs);
  }
  else
  {
    CostsAtSide<0>(sums, rule, side, begin, end, costs);
  }
}
}
