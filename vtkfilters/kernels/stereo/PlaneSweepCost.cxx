// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo/PlaneSweepCost.h"

#include "stereo/RowLoops.h"

#include <algorithm>
#include <bit>
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
  const int frameY = this->Rows.Box.YBegin + y;
  const int column0 = this->Rows.Box.XBegin - this->Rows.Radius;
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
