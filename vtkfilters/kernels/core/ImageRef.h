// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ImageRef_h
#define novelview_ImageRef_h

#include "core/ToInt.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace novelview
{
/**
 * Somebody else's pixels, read (or written) as rows from the top: pixel (0,0) is the top-left one.
 * The row stride is in elements and may be negative, which is how VTK's bottom-up images are seen
 * the right way up without a copy.
 */
template <class T>
class ImageRef
{
public:
  ImageRef() = default;
  ImageRef(T* topLeft, int width, int height, int channels, std::ptrdiff_t rowStride)
    : TopLeft(topLeft)
    , Width(width)
    , Height(height)
    , Channels(channels)
    , RowStride(rowStride)
  {
  }

  /** Pixels to write are pixels to read. */
  operator ImageRef<const T>() const requires(!std::is_const_v<T>)
  {
    return { this->TopLeft, this->Width, this->Height, this->Channels, this->RowStride };
  }

  bool Empty() const { return this->TopLeft == nullptr; }
  T* Row(int y) const { return this->TopLeft + y * this->RowStride; }
  T* Pixel(int x, int y) const { return this->Row(y) + x * this->Channels; }
  T& operator()(int x, int y, int channel = 0) const { return this->Pixel(x, y)[channel]; }
  bool Contains(int x, int y) const
  {
    return x >= 0 && y >= 0 && x < this->Width && y < this->Height;
  }

  T* TopLeft = nullptr;
  int Width = 0;
  int Height = 0;
  int Channels = 1;
  std::ptrdiff_t RowStride = 0;
};

/** An image that owns its pixels; rows from the top, channels interleaved. */
template <class T>
class Image
{
public:
  Image() = default;
  Image(int width, int height, int channels = 1, T value = T())
    : Width(width)
    , Height(height)
    , Channels(channels)
    , Values(static_cast<std::size_t>(width) * height * channels, value)
  {
  }

  ImageRef<T> Ref()
  {
    return { this->Values.data(), this->Width, this->Height, this->Channels, this->Stride() };
  }
  ImageRef<const T> Ref() const
  {
    return { this->Values.data(), this->Width, this->Height, this->Channels, this->Stride() };
  }
  T& operator()(int x, int y, int channel = 0)
  {
    return this->Values[(static_cast<std::size_t>(y) * this->Width + x) * this->Channels + channel];
  }
  const T& operator()(int x, int y, int channel = 0) const
  {
    return this->Values[(static_cast<std::size_t>(y) * this->Width + x) * this->Channels + channel];
  }

  int Width = 0;
  int Height = 0;
  int Channels = 1;
  std::vector<T> Values;

private:
  std::ptrdiff_t Stride() const
  {
    return static_cast<std::ptrdiff_t>(this->Width) * this->Channels;
  }
};

/**
 * Bilinear interpolation at (x, y), pixel centres on integers. Coordinates are clamped to the
 * image, so callers that must not read over the edge test that first; a NaN becomes 0.
 */
template <class T>
double SampleBilinear(const ImageRef<T>& image, double x, double y, int channel = 0)
{
  x = ClampedNumber(x, 0, image.Width - 1);
  y = ClampedNumber(y, 0, image.Height - 1);
  const int x0 = std::min(static_cast<int>(x), std::max(image.Width - 2, 0));
  const int y0 = std::min(static_cast<int>(y), std::max(image.Height - 2, 0));
  const int x1 = std::min(x0 + 1, image.Width - 1);
  const int y1 = std::min(y0 + 1, image.Height - 1);
  const double fx = x - x0;
  const double fy = y - y0;
  const double top = image(x0, y0, channel) * (1 - fx) + image(x1, y0, channel) * fx;
  const double bottom = image(x0, y1, channel) * (1 - fx) + image(x1, y1, channel) * fx;
  return top * (1 - fy) + bottom * fy;
}
}

#endif
