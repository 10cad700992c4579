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

/** Is the pixel nearest to a position inside the frame and object? */
bool IsObjectAt(const View& view, double x, double y)
{
  const int i = static_cast<int>(std::lround(x));
  const int j = static_cast<int>(std::lround(y));
  return view.Mask.Contains(i, j) && view.IsObject(i, j);
}

/** The three channels at a position inside the frame, bilinear. */
void SampleColor(const View& view, double x, double y, float rgb[3])
{
  const ImageRef<const std::uint8_t>& image = view.Color;
  x = std::clamp(x, 0.0, image.Width - 1.0);
  y = std::clamp(y, 0.0, image.Height - 1.0);
  const int x0 = std::min(static_cast<int>(x), std::max(image.Width - 2, 0));
  const int y0 = std::min(static_cast<int>(y), std::max(image.Height - 2, 0));
  const float fx = static_cast<float>(x - x0);
  const float fy = static_cast<float>(y - y0);
  const std::uint8_t* a = image.Pixel(x0, y0);
  const std::uint8_t* b = image.Pixel(x0, std::min(y0 + 1, image.Height - 1));
  const int right = image.Width > 1 ? 3 : 0;
  for (int channel = 0; channel < 3; ++channel)
  {
    const float top = a[channel] + fx * (a[channel + right] - a[channel]);
    const float bottom = b[channel] + fx * (b[channel + right] - b[channel]);
    rgb[channel] = top + fy * (bottom - top);
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
  double squares = 0;
  double keyPower = 0;
  double otherPower = 0;
  int count = 0;
  for (int j = -radius; j <= radius; ++j)
  {
    for (int i = -radius; i <= radius; ++i)
    {
      if (!IsObjectAt(key, keyCentre.x() + i, keyCentre.y() + j) ||
        !IsObjectAt(other, otherCentre.x() + i, otherCentre.y() + j))
      {
        continue;
      }
      float a[3];
      float b[3];
      SampleColor(key, keyCentre.x() + i, keyCentre.y() + j, a);
      SampleColor(other, otherCentre.x() + i, otherCentre.y() + j, b);
      ++count;
      for (int channel = 0; channel < 3; ++channel)
      {
        const double difference = a[channel] - b[channel];
        squares += difference * difference;
        keyPower += a[channel] * a[channel];
        otherPower += b[channel] * b[channel];
      }
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
  : Radius(radius)
  , Noise(noise)
{
  const int side = 2 * radius + 1;
  this->Key.resize(3 * side * side);
  this->Valid.resize(side * side);
  for (int n = 0; n < side * side; ++n)
  {
    const double x = keyCentre.x() + n % side - radius;
    const double y = keyCentre.y() + n / side - radius;
    this->Valid[n] = IsObjectAt(key, x, y);
    if (this->Valid[n])
    {
      SampleColor(key, x, y, &this->Key[3 * n]);
    }
  }
}

double WindowMatcher::Similarity(const View& other, const Vector2d& otherCentre) const
{
  const int side = 2 * this->Radius + 1;
  double sumA[3] = { 0, 0, 0 };
  double sumB[3] = { 0, 0, 0 };
  double squareA = 0;
  double squareB = 0;
  double product = 0;
  int count = 0;
  for (int n = 0; n < side * side; ++n)
  {
    const double x = otherCentre.x() + n % side - this->Radius;
    const double y = otherCentre.y() + n / side - this->Radius;
    if (!this->Valid[n] || !IsObjectAt(other, x, y))
    {
      continue;
    }
    const float* a = &this->Key[3 * n];
    float b[3];
    SampleColor(other, x, y, b);
    ++count;
    for (int channel = 0; channel < 3; ++channel)
    {
      sumA[channel] += a[channel];
      sumB[channel] += b[channel];
      squareA += a[channel] * a[channel];
      squareB += b[channel] * b[channel];
      product += a[channel] * b[channel];
    }
  }
  if (TooFew(count, this->Radius))
  {
    return 0;
  }
  for (int channel = 0; channel < 3; ++channel)
  {
    squareA -= sumA[channel] * sumA[channel] / count;
    squareB -= sumB[channel] * sumB[channel] / count;
    product -= sumA[channel] * sumB[channel] / count;
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
