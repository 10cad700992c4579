// SPDX-License-Identifier: GPL-3.0-or-later
// The loops over a row are plain so that the compiler does several pixels at once.
#include "stereo/PlaneSweepCost.h"

#include "core/FunctionMultiversioning.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace novelview
{
namespace
{
// Registers of several numbers; the compiler has the arithmetic built in. Numbers are widened by
// putting zeros between them: of the conversions it makes a dozen instructions each.
static_assert(std::endian::native == std::endian::little, "zeros go above the number");
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));
using Short8 = std::int16_t __attribute__((vector_size(16)));
using Byte16 = std::uint8_t __attribute__((vector_size(16)));

/** Two pixels side by side. */
Short8 LoadPair(const std::uint8_t* pixel)
{
  std::uint64_t both;
  std::memcpy(&both, pixel, sizeof(both));
  using Word2 = std::uint64_t __attribute__((vector_size(16)));
  const Byte16 bytes = reinterpret_cast<Byte16>(Word2{ both, 0 });
  return reinterpret_cast<Short8>(__builtin_shufflevector(
    bytes, Byte16{}, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23));
}

/** Bilinear R, G, B, luma, times 128. */
Float4 SamplePixel(const std::uint8_t* top, std::size_t stride, std::int16_t down, float right)
{
  const Short8 above = LoadPair(top);
  const Short8 column = above * 128 + (LoadPair(top + stride) - above) * down;
  const Short8 low = __builtin_shufflevector(column, Short8{}, 0, 8, 1, 9, 2, 10, 3, 11);
  const Short8 high = __builtin_shufflevector(column, Short8{}, 4, 12, 5, 13, 6, 14, 7, 15);
  const Float4 a = __builtin_convertvector(reinterpret_cast<Int4>(low), Float4);
  const Float4 b = __builtin_convertvector(reinterpret_cast<Int4>(high), Float4);
  return a + right * (b - a);
}

/** Where the rays of a row meet a neighbour; see PlaneSweepCost::Hits. */
struct RayRow
{
  const float* Base; ///< depths; of column 0, as are all others
  const float* Last;
  std::int32_t* First;
  std::int32_t* Nearest;
  std::int32_t* Down;
  float* Right;
};

/** A ray's way through a neighbour: Slope column + Start, times depth, plus End. */
struct RayWay
{
  float Slope[3], Start[3], End[3];
};

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

/** The pixels of a row: those of the reference, those of the neighbour, and what they give. */
struct PairRow
{
  const std::uint8_t* Red;
  const std::uint8_t* Green;
  const std::uint8_t* Blue;
  const std::uint8_t* Luma;
  const float* Picked;         ///< R, G, B, luma of the neighbour, times 128
  const std::int32_t* Nearest; ///< negative where there is none
  std::uint8_t* Count;
  std::uint8_t* KeyLuma;
  std::uint8_t* OtherLuma;
  std::uint8_t* Difference;
};

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

/** sums[i] += entering[i] - leaving[i]. */
NOVELVIEW_CLONES void AddChange(std::uint16_t* __restrict sums,
  const std::uint8_t* __restrict entering, const std::uint8_t* __restrict leaving, int begin,
  int end)
{
  for (int i = begin; i < end; ++i)
  {
    sums[i] = static_cast<std::uint16_t>(sums[i] + entering[i] - leaving[i]);
  }
}

/** The same for products of two factors. */
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

/** What CostsOfColumns needs to know. */
struct CostRule
{
  float MinCount;
  float ShareOfColor;
  float Noise;
};

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

/** Sums over the columns of each sort. */
struct ColumnSums
{
  const std::uint16_t* Count;
  const std::uint16_t* Reference;
  const std::uint16_t* Other;
  const std::uint16_t* Difference;
  const std::int32_t* Reference2;
  const std::int32_t* Other2;
  const std::int32_t* Product;
};

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

ReferenceRows::ReferenceRows(const MatchImage& reference, const Image<float>& base,
  const Image<float>& last, const PixelBox& box, int radius)
  : Cam(reference.Cam)
  , Box(box)
  , Radius(radius)
  , Width(box.Width() + 2 * radius)
  , Spans(box.Height() + 2 * radius)
{
  const std::size_t size = this->Spans.size() * this->Width;
  this->Base.assign(size, 0.f);
  this->Last.assign(size, 0.f);
  for (auto* channel : { &this->Red, &this->Green, &this->Blue, &this->Luma })
  {
    channel->assign(size, 0);
  }
  for (int y = -radius; y < box.Height() + radius; ++y)
  {
    if (box.Y0 + y >= 0 && box.Y0 + y < base.Height)
    {
      this->ReadRow(reference, base, last, y);
    }
  }
}

void ReferenceRows::ReadRow(
  const MatchImage& reference, const Image<float>& base, const Image<float>& last, int y)
{
  Span& span = this->Spans[y + this->Radius];
  const std::size_t row = static_cast<std::size_t>(y + this->Radius) * this->Width;
  const int frameY = this->Box.Y0 + y;
  for (int i = 0; i < this->Width; ++i)
  {
    const int frameX = this->Box.X0 - this->Radius + i;
    if (frameX < 0 || frameX >= base.Width || base(frameX, frameY) <= 0)
    {
      continue;
    }
    this->Base[row + i] = base(frameX, frameY);
    this->Last[row + i] = last(frameX, frameY);
    this->Red[row + i] = reference.Pixels(frameX, frameY, 0);
    this->Green[row + i] = reference.Pixels(frameX, frameY, 1);
    this->Blue[row + i] = reference.Pixels(frameX, frameY, 2);
    this->Luma[row + i] = reference.Pixels(frameX, frameY, 3);
    span = { span.Empty() ? i : span.Begin, i + 1, std::max(span.Last, last(frameX, frameY)) };
  }
}

PlaneSweepCost::PlaneSweepCost(
  const ReferenceRows& rows, const MatchImage& other, const MatchOptions& options)
  : Rows(rows)
  , Other(other)
  , Side(2 * rows.Radius + 1)
  , ShareOfColor(static_cast<float>(options.ColorShare))
  , Noise(static_cast<float>(options.Noise))
  , LevelsPerGrey(static_cast<float>(255 / options.ColorTruncation))
{
  const Camera& reference = rows.Cam;
  const Eigen::Matrix3d rotation = other.Cam.R * reference.R.transpose();
  this->H = (other.Cam.K * rotation * reference.K.inverse()).cast<float>();
  this->E = (other.Cam.K * (other.Cam.T - rotation * reference.T)).cast<float>();
  const std::size_t width = rows.Width;
  this->Hit = { std::vector<std::int32_t>(width), std::vector<std::int32_t>(width),
    std::vector<std::int32_t>(width), std::vector<float>(width) };
  this->Picked.resize(4 * width);
  const std::vector<std::uint8_t> zeros(width);
  this->Ring.assign(this->Side + 1, { {}, zeros, zeros, zeros, zeros });
  const std::vector<std::uint16_t> small(width);
  const std::vector<std::int32_t> large(width);
  this->Sum = { small, small, small, small, large, large, large };
}

void PlaneSweepCost::Start(double offset)
{
  this->Offset = static_cast<float>(offset);
  for (Samples& row : this->Ring)
  {
    row.Clear();
    row.Span = {};
  }
  for (auto* sums :
    { &this->Sum.Count, &this->Sum.Reference, &this->Sum.Other, &this->Sum.Difference })
  {
    std::fill(sums->begin(), sums->end(), 0);
  }
  for (auto* sums : { &this->Sum.Reference2, &this->Sum.Other2, &this->Sum.Product })
  {
    std::fill(sums->begin(), sums->end(), 0);
  }
}

void PlaneSweepCost::Samples::Clear()
{
  for (auto* values : { &this->Count, &this->Reference, &this->Other, &this->Difference })
  {
    std::fill(values->begin() + this->Span.Begin, values->begin() + this->Span.End, 0);
  }
}

void PlaneSweepCost::Enter(int y)
{
  this->Newest = y;
  Samples& entering = this->RowOf(y);
  entering.Clear();
  entering.Span = this->Rows.SpanOf(y);
  if (this->Offset > entering.Span.Last)
  {
    entering.Span = {};
  }
  if (!entering.Span.Empty())
  {
    this->Project(y, entering.Span);
    this->Gather(entering.Span);
    this->Compare(y, entering);
  }
  this->Replace(entering, this->RowOf(y - this->Side));
}

void PlaneSweepCost::Project(int y, const ReferenceRows::Span& span)
{
  const int frameY = this->Rows.Box.Y0 + y;
  const int column0 = this->Rows.Box.X0 - this->Rows.Radius;
  const Eigen::Vector3f start = this->H.col(0) * static_cast<float>(column0) +
    this->H.col(1) * static_cast<float>(frameY) + this->H.col(2);
  RayWay way;
  for (int k = 0; k < 3; ++k)
  {
    way.Slope[k] = this->H(k, 0);
    way.Start[k] = start[k];
    way.End[k] = this->E[k];
  }
  const RayRow row{ this->Rows.Row(this->Rows.Base, y), this->Rows.Row(this->Rows.Last, y),
    this->Hit.First.data(), this->Hit.Nearest.data(), this->Hit.Down.data(),
    this->Hit.Right.data() };
  ProjectColumns(row, way, this->Offset, this->Other.Pixels.Width, this->Other.Pixels.Height,
    span.Begin, span.End);
}

void PlaneSweepCost::Gather(const ReferenceRows::Span& span)
{
  const std::uint8_t* pixels = this->Other.Pixels.Values.data();
  const std::size_t stride = 4 * static_cast<std::size_t>(this->Other.Pixels.Width);
  const std::int32_t* first = this->Hit.First.data();
  const std::int32_t* down = this->Hit.Down.data();
  const float* right = this->Hit.Right.data();
  std::int32_t* nearest = this->Hit.Nearest.data();
  float* picked = this->Picked.data();
  for (int i = span.Begin; i < span.End; ++i)
  {
    if (nearest[i] < 0 || pixels[4 * static_cast<std::size_t>(nearest[i]) + 3] == 0)
    {
      nearest[i] = -1;
      continue;
    }
    const Float4 pixel = SamplePixel(pixels + 4 * static_cast<std::size_t>(first[i]), stride,
      static_cast<std::int16_t>(down[i]), right[i]);
    std::memcpy(picked + 4 * i, &pixel, sizeof(pixel));
  }
}

void PlaneSweepCost::Compare(int y, Samples& row) const
{
  const ReferenceRows& reference = this->Rows;
  const PairRow pair{ reference.Row(reference.Red, y), reference.Row(reference.Green, y),
    reference.Row(reference.Blue, y), reference.Row(reference.Luma, y), this->Picked.data(),
    this->Hit.Nearest.data(), row.Count.data(), row.Reference.data(), row.Other.data(),
    row.Difference.data() };
  CompareColumns(pair, this->LevelsPerGrey, row.Span.Begin, row.Span.End);
}

void PlaneSweepCost::Replace(const Samples& in, const Samples& out)
{
  if (in.Span.Empty() && out.Span.Empty())
  {
    return;
  }
  const bool one = in.Span.Empty() || out.Span.Empty();
  const ReferenceRows::Span& any = in.Span.Empty() ? out.Span : in.Span;
  const int begin = one ? any.Begin : std::min(in.Span.Begin, out.Span.Begin);
  const int end = one ? any.End : std::max(in.Span.End, out.Span.End);
  Columns& sum = this->Sum;
  AddChange(sum.Count.data(), in.Count.data(), out.Count.data(), begin, end);
  AddChange(sum.Reference.data(), in.Reference.data(), out.Reference.data(), begin, end);
  AddChange(sum.Other.data(), in.Other.data(), out.Other.data(), begin, end);
  AddChange(sum.Difference.data(), in.Difference.data(), out.Difference.data(), begin, end);
  const auto products = [&](std::vector<std::int32_t>& sums, auto Samples::*a, auto Samples::*b)
  {
    AddChange(
      sums.data(), (in.*a).data(), (in.*b).data(), (out.*a).data(), (out.*b).data(), begin, end);
  };
  products(sum.Reference2, &Samples::Reference, &Samples::Reference);
  products(sum.Other2, &Samples::Other, &Samples::Other);
  products(sum.Product, &Samples::Reference, &Samples::Other);
}

bool PlaneSweepCost::Costs(std::int16_t* costs)
{
  const bool nothing = std::all_of(
    this->Ring.begin(), this->Ring.end(), [](const Samples& row) { return row.Span.Empty(); });
  const ReferenceRows::Span span = this->Rows.SpanOf(this->Newest - this->Rows.Radius);
  const int begin = std::max(span.Begin - this->Rows.Radius, 0);
  const int end = std::min(span.End - this->Rows.Radius, this->Rows.Box.Width());
  if (nothing || begin >= end)
  {
    return false;
  }
  const Columns& sum = this->Sum;
  const ColumnSums sums{ sum.Count.data(), sum.Reference.data(), sum.Other.data(),
    sum.Difference.data(), sum.Reference2.data(), sum.Other2.data(), sum.Product.data() };
  const int quarter = (this->Side * this->Side + 3) / 4;
  const CostRule rule{ static_cast<float>(quarter), this->ShareOfColor, this->Noise };
  CostsOfColumns(sums, rule, this->Side, begin, end, costs);
  return true;
}
}
