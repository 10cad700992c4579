// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo/MaskedMedian.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace novelview
{
namespace
{
// Windows of four neighbouring pixels side by side.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

void Sort(Float4& a, Float4& b)
{
  const Float4 smaller = a < b ? a : b;
  b = a < b ? b : a;
  a = smaller;
}

/**
 * The upper median of an odd number of values, which are lost: of any more than half of them,
 * neither the least nor the largest is the median of all, so that both give way to the next.
 */
Float4 MedianOf(std::vector<Float4>& values)
{
  std::size_t next = values.size() / 2 + 2;
  for (std::size_t last = next - 1; last > 1; --last)
  {
    for (std::size_t i = 1; i <= last; ++i)
    {
      Sort(values[0], values[i]);
    }
    for (std::size_t i = 1; i < last; ++i)
    {
      Sort(values[i], values[last]);
    }
    if (next < values.size())
    {
      values[0] = values[next++];
    }
  }
  return values[1];
}

/**
 * Puts infinity and 0 in turns in the place of what is unknown, which leaves the upper median where
 * it is.
 */
void BalanceUnknown(std::vector<Float4>& values)
{
  const Float4 most = Float4{} + std::numeric_limits<float>::infinity();
  Float4 substitute = most;
  for (Float4& value : values)
  {
    const Int4 unknown = value <= 0;
    value = unknown ? substitute : value;
    const Float4 other = substitute > 0 ? Float4{} : most;
    substitute = unknown ? other : substitute;
  }
}
}

Image<float> MaskedMedian(const Image<float>& image, int radius)
{
  constexpr int lanes = 4;
  const int side = 2 * radius + 1;
  const int width = image.Width + 2 * radius + lanes;
  Image<float> result(image.Width, image.Height);
  // The rows around the present one, with unknowns all around.
  std::vector<std::vector<float>> rows(side, std::vector<float>(width, 0.f));
  std::vector<Float4> values(static_cast<std::size_t>(side) * side);
  const auto read = [&](int y)
  {
    std::vector<float>& row = rows[(y + side) % side];
    if (y < image.Height)
    {
      std::copy_n(&image(0, y), image.Width, row.begin() + radius);
    }
    else
    {
      std::fill(row.begin(), row.end(), 0.f);
    }
  };
  for (int y = -radius; y < image.Height; ++y)
  {
    read(y + radius);
    for (int x = 0; y >= 0 && x < image.Width; x += lanes)
    {
      const float* here = &image(x, y);
      const int count = std::min(lanes, image.Width - x);
      if (std::all_of(here, here + count, [](float value) { return value <= 0; }))
      {
        continue;
      }
      for (int n = 0; n < side * side; ++n)
      {
        std::memcpy(&values[n], rows[n / side].data() + x + n % side, sizeof(Float4));
      }
      BalanceUnknown(values);
      const Float4 median = MedianOf(values);
      for (int lane = 0; lane < count; ++lane)
      {
        result(x + lane, y) = here[lane] > 0 ? median[lane] : 0.f;
      }
    }
  }
  return result;
}
}
