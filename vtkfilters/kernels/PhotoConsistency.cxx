// SPDX-License-Identifier: GPL-3.0-or-later
#include "PhotoConsistency.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

/** The three channels of a window's pixels, row by row, and which of them are object. */
struct Window
{
  static constexpr int MaxRadius = 7;
  static constexpr int MaxPixels = (2 * MaxRadius + 1) * (2 * MaxRadius + 1);

  float Values[3 * MaxPixels];
  bool Valid[MaxPixels];
};

/**
 * Reads a window around a position between pixels. A window's pixels are whole steps apart, so the
 * four weights of the bilinear interpolation are the same for all of them. Pixels outside the frame
 * are not valid.
 */
void ReadWindow(const View& view, const Vector2d& centre, int radius, Window& window)
{
  const ImageRef<const std::uint8_t>& image = view.Color;
  const int side = 2 * radius + 1;
  const int firstX = static_cast<int>(std::floor(centre.x())) - radius;
  const int firstY = static_cast<int>(std::floor(centre.y())) - radius;
  const auto fx = static_cast<float>(centre.x() - std::floor(centre.x()));
  const auto fy = static_cast<float>(centre.y() - std::floor(centre.y()));
  const int nearX = fx >= 0.5f ? 1 : 0;
  const int nearY = fy >= 0.5f ? 1 : 0;
  int n = 0;
  for (int y = firstY; y < firstY + side; ++y)
  {
    for (int x = firstX; x < firstX + side; ++x, ++n)
    {
      window.Valid[n] =
        view.Mask.Contains(x + nearX, y + nearY) && view.IsObject(x + nearX, y + nearY);
      if (!window.Valid[n])
      {
        continue;
      }
      // At the frame's border the missing neighbour is the border pixel itself.
      const int x0 = std::max(x, 0);
      const int y0 = std::max(y, 0);
      const int right = x >= 0 && x + 1 < image.Width ? 3 : 0;
      const std::uint8_t* top = image.Pixel(x0, y0);
      const std::uint8_t* bottom = y >= 0 && y + 1 < image.Height ? image.Pixel(x0, y0 + 1) : top;
      for (int channel = 0; channel < 3; ++channel)
      {
        const float a = top[channel] + fx * (top[channel + right] - top[channel]);
        const float b = bottom[channel] + fx * (bottom[channel + right] - bottom[channel]);
        window.Values[3 * n + channel] = a + fy * (b - a);
      }
    }
  }
}

bool TooFew(int count, int radius)
{
  const int side = 2 * radius + 1;
  return 4 * count < side * side;
}
}

double WindowDifference(const View& key, const Vector2d& keyCentre, const View& other,
  const Vector2d& otherCentre, int radius)
{
  Window a;
  Window b;
  ReadWindow(key, keyCentre, radius, a);
  ReadWindow(other, otherCentre, radius, b);
  double squares = 0;
  double keyPower = 0;
  double otherPower = 0;
  int count = 0;
  for (int n = 0; n < (2 * radius + 1) * (2 * radius + 1); ++n)
  {
    if (!a.Valid[n] || !b.Valid[n])
    {
      continue;
    }
    ++count;
    for (int i = 3 * n; i < 3 * n + 3; ++i)
    {
      const double difference = a.Values[i] - b.Values[i];
      squares += difference * difference;
      keyPower += a.Values[i] * a.Values[i];
      otherPower += b.Values[i] * b.Values[i];
    }
  }
  if (TooFew(count, radius))
  {
    return 1;
  }
  const double power = std::sqrt(keyPower * otherPower);
  return power > 0 ? std::min(squares / power, 1.0) : (squares > 0 ? 1 : 0);
}

WindowMatcher::WindowMatcher(const View& key, const Vector2d& keyCentre, int radius, double noise)
  : Radius(std::min(radius, Window::MaxRadius))
  , Noise(noise)
{
  const int pixels = (2 * this->Radius + 1) * (2 * this->Radius + 1);
  Window window;
  ReadWindow(key, keyCentre, this->Radius, window);
  this->Key.assign(window.Values, window.Values + 3 * pixels);
  this->Valid.assign(window.Valid, window.Valid + pixels);
}

double WindowMatcher::Similarity(const View& other, const Vector2d& otherCentre) const
{
  Window window;
  ReadWindow(other, otherCentre, this->Radius, window);
  float sumA[3] = { 0, 0, 0 };
  float sumB[3] = { 0, 0, 0 };
  double squareA = 0;
  double squareB = 0;
  double product = 0;
  int count = 0;
  for (std::size_t n = 0; n < this->Valid.size(); ++n)
  {
    if (!this->Valid[n] || !window.Valid[n])
    {
      continue;
    }
    ++count;
    for (int channel = 0; channel < 3; ++channel)
    {
      const float a = this->Key[3 * n + channel];
      const float b = window.Values[3 * n + channel];
      sumA[channel] += a;
      sumB[channel] += b;
      squareA += a * a;
      squareB += b * b;
      product += a * b;
    }
  }
  if (TooFew(count, this->Radius))
  {
    return 0;
  }
  for (int channel = 0; channel < 3; ++channel)
  {
    squareA -= static_cast<double>(sumA[channel]) * sumA[channel] / count;
    squareB -= static_cast<double>(sumB[channel]) * sumB[channel] / count;
    product -= static_cast<double>(sumA[channel]) * sumB[channel] / count;
  }
  const double floor = 3 * count * this->Noise;
  return std::max(product, 0.0) / std::sqrt((squareA + floor) * (squareB + floor));
}

bool Triangulate(const Camera& key, const Vector2d& keyPixel, const Camera& other,
  const Vector2d& otherPixel, Vector3d& point)
{
  const Vector3d a = key.RayDirection(keyPixel);
  const Vector3d b = other.RayDirection(otherPixel);
  const Vector3d between = other.Centre() - key.Centre();
  const double ab = a.dot(b);
  const double sine2 = 1 - ab * ab;
  if (sine2 < 1e-6) // rays within a milliradian of each other meet nowhere in particular
  {
    return false;
  }
  const double alongKey = (between.dot(a) - ab * between.dot(b)) / sine2;
  const double alongOther = (ab * between.dot(a) - between.dot(b)) / sine2;
  point = key.Centre() + alongKey * a;
  return alongKey > 0 && alongOther > 0;
}
}
