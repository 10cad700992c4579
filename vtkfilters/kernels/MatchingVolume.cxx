// SPDX-License-Identifier: GPL-3.0-or-later
#include "MatchingVolume.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace novelview
{
namespace
{
// Four floats in one register; the compiler has the arithmetic built in.
using Float4 = float __attribute__((vector_size(16)));

Float4 LoadPixel(const std::uint8_t* pixel)
{
  using Byte4 = std::uint8_t __attribute__((vector_size(4)));
  Byte4 bytes;
  std::memcpy(&bytes, pixel, sizeof(bytes));
  return __builtin_convertvector(bytes, Float4);
}

/** Bilinear R, G, B, luma; the position must have all four pixels in the frame. */
Float4 SamplePixel(const Image<std::uint8_t>& image, float x, float y)
{
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const float fx = x - static_cast<float>(x0);
  const float fy = y - static_cast<float>(y0);
  const std::uint8_t* top =
    image.Values.data() + (static_cast<std::size_t>(y0) * image.Width + x0) * 4;
  const std::uint8_t* bottom = top + static_cast<std::size_t>(image.Width) * 4;
  const Float4 a = LoadPixel(top);
  const Float4 b = LoadPixel(bottom);
  const Float4 left = a + fy * (b - a);
  const Float4 c = LoadPixel(top + 4);
  const Float4 d = LoadPixel(bottom + 4);
  const Float4 right = c + fy * (d - c);
  return left + fx * (right - left);
}

/** What a window sums up: {count, I, W, |dRGB|} and {I^2, W^2, IW, unused}. */
struct WindowSums
{
  Float4 First{};
  Float4 Second{};

  void Add(const WindowSums& other)
  {
    this->First += other.First;
    this->Second += other.Second;
  }
};

float WindowCost(const WindowSums& sums, int leastCount, const MatchOptions& options)
{
  const float count = sums.First[0];
  if (count < static_cast<float>(leastCount))
  {
    return 1;
  }
  const float noise = static_cast<float>(options.Noise) * count * count;
  const float varianceI = count * sums.Second[0] - sums.First[1] * sums.First[1] + noise;
  const float varianceW = count * sums.Second[1] - sums.First[2] * sums.First[2] + noise;
  const float covariance = count * sums.Second[2] - sums.First[1] * sums.First[2];
  const float correlation = std::max(covariance, 0.f) / std::sqrt(varianceI * varianceW);
  const float share = static_cast<float>(options.ColorShare);
  return (1 - share) * 0.5f * (1 - correlation) + share * sums.First[3] / count;
}

/** One key row's pixels: where their rays run in a neighbour, for one row at a time. */
class RowMatcher
{
public:
  RowMatcher(const MatchImage& key, const MatchImage& other, const Image<float>& base,
    const Image<float>& last, const PixelBox& box, const MatchOptions& options)
    : Key(key)
    , Other(other)
    , Base(base)
    , Last(last)
    , Box(box)
    , Options(options)
  {
    // Pixel (x, y) at depth d of the key projects to H (x, y, 1) d + e in the neighbour.
    const Eigen::Matrix3d rotation = other.Cam.R * key.Cam.R.transpose();
    this->H = (other.Cam.K * rotation * key.Cam.K.inverse()).cast<float>();
    this->E = (other.Cam.K * (other.Cam.T - rotation * key.Cam.T)).cast<float>();
  }

  /** Fills one entry per pixel of the row (plus a margin of the radius on both sides). */
  void Products(int y, double offset, std::vector<WindowSums>& row) const
  {
    const int radius = this->Options.WindowRadius;
    const int width = this->Box.Width();
    std::fill(row.begin(), row.end(), WindowSums());
    const int frameY = this->Box.Y0 + y;
    if (frameY < 0 || frameY >= this->Key.Pixels.Height)
    {
      return;
    }
    const float maxX = static_cast<float>(this->Other.Pixels.Width - 1);
    const float maxY = static_cast<float>(this->Other.Pixels.Height - 1);
    const float truncation = static_cast<float>(this->Options.ColorTruncation);
    const Eigen::Vector3f rowStart = this->H.col(1) * static_cast<float>(frameY) + this->H.col(2);
    for (int i = -radius; i < width + radius; ++i)
    {
      const int frameX = this->Box.X0 + i;
      if (frameX < 0 || frameX >= this->Key.Pixels.Width || this->Base(frameX, frameY) <= 0 ||
        offset > this->Last(frameX, frameY))
      {
        continue;
      }
      const float depth = this->Base(frameX, frameY) + static_cast<float>(offset);
      const Eigen::Vector3f p =
        (this->H.col(0) * static_cast<float>(frameX) + rowStart) * depth + this->E;
      const float x = p.x() / p.z();
      const float y2 = p.y() / p.z();
      if (!(p.z() > 0 && x >= 0 && y2 >= 0 && x < maxX && y2 < maxY))
      {
        continue;
      }
      const std::size_t nearest = static_cast<std::size_t>(y2 + 0.5f) * this->Other.Pixels.Width +
        static_cast<std::size_t>(x + 0.5f);
      if (this->Other.Pixels.Values[nearest * 4 + 3] == 0)
      {
        continue;
      }
      const Float4 a = LoadPixel(this->Key.Pixels.Values.data() +
        (static_cast<std::size_t>(frameY) * this->Key.Pixels.Width + frameX) * 4);
      const Float4 b = SamplePixel(this->Other.Pixels, x, y2);
      const Float4 d = a - b;
      const float difference = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      WindowSums& sums = row[i + radius];
      sums.First = Float4{ 1, a[3], b[3], std::min(difference, truncation) / truncation };
      sums.Second = Float4{ a[3] * a[3], b[3] * b[3], a[3] * b[3], 0 };
    }
  }

private:
  const MatchImage& Key;
  const MatchImage& Other;
  const Image<float>& Base;
  const Image<float>& Last;
  const PixelBox& Box;
  const MatchOptions& Options;
  Eigen::Matrix3f H;
  Eigen::Vector3f E;
};

/** Costs of one neighbour at one offset, one row of the box after the other. */
class PlaneMatcher
{
public:
  PlaneMatcher(const RowMatcher& rows, int width, const MatchOptions& options)
    : Rows(rows)
    , Radius(options.WindowRadius)
    , Options(options)
    , Ring(2 * options.WindowRadius + 1, std::vector<WindowSums>(width + 2 * options.WindowRadius))
    , Columns(width + 2 * options.WindowRadius)
  {
  }

  /** Calls take(y, costs) for each row of a box of this height. */
  template <class Take>
  void ForEachRow(int height, double offset, const Take& take)
  {
    const int side = 2 * this->Radius + 1;
    const int width = static_cast<int>(this->Columns.size()) - 2 * this->Radius;
    const int leastCount = (side * side + 3) / 4;
    std::vector<float> costs(width);
    for (int y = -this->Radius; y < height + this->Radius; ++y)
    {
      this->Rows.Products(y, offset, this->Ring[(y + this->Radius) % side]);
      const int middle = y - this->Radius;
      if (middle < 0)
      {
        continue;
      }
      for (std::size_t x = 0; x < this->Columns.size(); ++x)
      {
        this->Columns[x] = this->Ring[0][x];
        for (int k = 1; k < side; ++k)
        {
          this->Columns[x].Add(this->Ring[k][x]);
        }
      }
      for (int x = 0; x < width; ++x)
      {
        WindowSums window = this->Columns[x];
        for (int k = 1; k < side; ++k)
        {
          window.Add(this->Columns[x + k]);
        }
        costs[x] = WindowCost(window, leastCount, this->Options);
      }
      take(middle, costs.data());
    }
  }

private:
  const RowMatcher& Rows;
  int Radius;
  const MatchOptions& Options;
  std::vector<std::vector<WindowSums>> Ring;
  std::vector<WindowSums> Columns;
};
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

MatchingVolume MatchNeighbours(const MatchImage& key, const Image<float>& base,
  const Image<float>& last, const std::vector<const MatchImage*>& neighbours, const PixelBox& box,
  const OffsetLabels& labels, const MatchOptions& options)
{
  MatchingVolume volume;
  volume.Box = box;
  volume.Labels = labels;
  const int width = box.Width();
  const int height = box.Height();
  volume.Costs.assign(static_cast<std::size_t>(width) * height * labels.Count, 1.f);
  const int best = std::min(options.BestNeighbours, static_cast<int>(neighbours.size()));
  if (best == 0)
  {
    return volume;
  }
  // The least costs so far, per rank and pixel of one label.
  std::vector<std::vector<float>> least(best);
  for (int label = 0; label < labels.Count; ++label)
  {
    for (auto& rank : least)
    {
      rank.assign(static_cast<std::size_t>(width) * height, 1.f);
    }
    for (const MatchImage* other : neighbours)
    {
      const RowMatcher rows(key, *other, base, last, box, options);
      PlaneMatcher(rows, width, options)
        .ForEachRow(height, labels.Offset(label),
          [&](int y, const float* costs)
          {
            for (int x = 0; x < width; ++x)
            {
              float cost = costs[x];
              for (auto& rank : least)
              {
                float& slot = rank[static_cast<std::size_t>(y) * width + x];
                const float smaller = std::min(slot, cost);
                cost = std::max(slot, cost);
                slot = smaller;
              }
            }
          });
    }
    for (int y = 0; y < height; ++y)
    {
      float* row = volume.Row(y, label);
      for (int x = 0; x < width; ++x)
      {
        float sum = 0;
        for (const auto& rank : least)
        {
          sum += rank[static_cast<std::size_t>(y) * width + x];
        }
        row[x] = sum / static_cast<float>(best);
      }
    }
  }
  return volume;
}
}
