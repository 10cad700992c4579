// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo/PhotoConsistency.h"

#include "core/FunctionMultiversioning.h"
#include "core/ToInt.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace novelview
{
using Eigen::Vector2d;
using Eigen::Vector3d;
namespace
{
/** Windows are worked on in columns, so many at a time. */
constexpr int Block = 8;
using Floats [[gnu::vector_size(4 * Block)]] = float;
using FourFloats [[gnu::vector_size(16)]] = float;
using FourInts [[gnu::vector_size(16)]] = std::int32_t;
using EightInts [[gnu::vector_size(4 * Block)]] = std::int32_t;
static_assert(std::endian::native == std::endian::little);

/** Four bytes as numbers, by putting zeros between them: compilers convert them one by one. */
[[gnu::always_inline]] inline void LoadBytes(const std::uint8_t* from, FourInts& values)
{
  using Bytes [[gnu::vector_size(16)]] = std::uint8_t;
  using Words [[gnu::vector_size(16)]] = std::uint16_t;
  FourInts packed{};
  std::memcpy(&packed, from, 4);
  const auto words = (Words)__builtin_shufflevector(
    (Bytes)packed, Bytes{}, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
  values = (FourInts)__builtin_shufflevector(words, Words{}, 0, 8, 1, 9, 2, 10, 3, 11);
}

/** Eight bytes as numbers; three instructions where there is a shuffle of bytes, many elsewhere. */
[[gnu::always_inline, maybe_unused]] inline void LoadBytes(
  const std::uint8_t* from, EightInts& values)
{
  using Bytes [[gnu::vector_size(32)]] = std::uint8_t;
  using Octets [[gnu::vector_size(32)]] = std::uint64_t;
  std::uint64_t packed;
  std::memcpy(&packed, from, 8);
  const auto repeated = (Bytes)Octets{ packed, packed, packed, packed };
  const auto spread = (EightInts)__builtin_shufflevector(repeated, repeated, 0, 0, 0, 0, 1, 1, 1, 1,
    2, 2, 2, 2, 3, 3, 3, 3, 20, 20, 20, 20, 21, 21, 21, 21, 22, 22, 22, 22, 23, 23, 23, 23);
  values = spread & 0xff;
}

/** How many values a row of a window takes: 3 (2 radius + 1) and what fills the last block. */
int ColumnsOf(int radius)
{
  return (3 * (2 * radius + 1) + Block - 1) / Block * Block;
}

/** Interpolate() by as many values at once as `Numbers` and `Ints` hold. */
template <class Numbers, class Ints>
[[gnu::always_inline]] inline void InterpolateBlocks(const std::uint8_t* topLeft,
  std::ptrdiff_t stride, float fx, float fy, int rows, int columns, float* values)
{
  const auto across = [fx](const std::uint8_t* from, Numbers& value) __attribute__((always_inline))
  {
    Ints left;
    Ints right;
    LoadBytes(from, left);
    LoadBytes(from + 3, right);
    value =
      __builtin_convertvector(left, Numbers) + fx * __builtin_convertvector(right - left, Numbers);
  };
  for (int first = 0; first < columns; first += static_cast<int>(sizeof(Numbers) / sizeof(float)))
  {
    const std::uint8_t* from = topLeft + first;
    Numbers above;
    across(from, above);
    for (int row = 0; row < rows; ++row)
    {
      from += stride;
      Numbers below;
      across(from, below);
      const Numbers value = above + fy * (below - above);
      std::memcpy(values + row * columns + first, &value, sizeof(value));
      above = below;
    }
  }
}

/**
 * Bilinear interpolation of all values of a window. Its pixels are whole steps apart, so the four
 * weights are the same for all of them. `topLeft` is the pixel left of and above the first; from
 * there columns + 3 bytes are read of each row and the one below the last.
 */
NOVELVIEW_FOR_ANY void Interpolate(const std::uint8_t* topLeft, std::ptrdiff_t stride, float fx,
  float fy, int rows, int columns, float* values)
{
  InterpolateBlocks<FourFloats, FourInts>(topLeft, stride, fx, fy, rows, columns, values);
}

#ifdef NOVELVIEW_FOR_AVX2
NOVELVIEW_FOR_AVX2 void Interpolate(const std::uint8_t* topLeft, std::ptrdiff_t stride, float fx,
  float fy, int rows, int columns, float* values)
{
  InterpolateBlocks<Floats, EightInts>(topLeft, stride, fx, fy, rows, columns, values);
}
#endif

/** The same for a window that reaches over the frame's border, where the border's pixels go on. */
void InterpolateAtBorder(const ImageRef<const std::uint8_t>& image, int firstX, int firstY,
  float fx, float fy, int radius, int columns, float* values)
{
  const int side = 2 * radius + 1;
  for (int row = 0; row < side; ++row)
  {
    const int y0 = std::clamp(firstY + row, 0, image.Height - 1);
    const int y1 = std::clamp(firstY + row + 1, 0, image.Height - 1);
    float* out = values + row * columns;
    for (int i = 0; i < 3 * side; ++i)
    {
      const int x0 = std::clamp(firstX + i / 3, 0, image.Width - 1);
      const int x1 = std::clamp(firstX + i / 3 + 1, 0, image.Width - 1);
      const float a = image(x0, y0, i % 3) + fx * (image(x1, y0, i % 3) - image(x0, y0, i % 3));
      const float b = image(x0, y1, i % 3) + fx * (image(x1, y1, i % 3) - image(x0, y1, i % 3));
      out[i] = a + fy * (b - a);
    }
    std::fill(out + 3 * side, out + columns, 0.f);
  }
}

/** Whether a square of pixels is known to be all object and inside the frame. */
bool AllObject(const View& view, int firstX, int firstY, int side)
{
  if (!view.Mask.Contains(firstX, firstY) ||
    !view.Mask.Contains(firstX + side - 1, firstY + side - 1))
  {
    return false;
  }
  if (side < 8 && firstX + 8 > view.Mask.Width)
  {
    return false; // not known: eight pixels are looked at at once
  }
  // Above 127 is the highest bit. Wider windows are two words, which may overlap.
  std::uint64_t all = ~std::uint64_t(0);
  for (int y = firstY; y < firstY + side; ++y)
  {
    const std::uint8_t* row = view.Mask.Pixel(firstX, y);
    std::uint64_t words[2];
    std::memcpy(&words[0], row, 8);
    std::memcpy(&words[1], row + std::max(side - 8, 0), 8);
    all &= words[0] & words[1];
  }
  const std::uint64_t wanted = 0x8080808080808080u >> (8 * std::max(8 - side, 0));
  return (all & wanted) == wanted;
}

/** Which values are object, by the pixel that each is nearest to; outside the frame none is. */
void ReadObject(const View& view, int firstX, int firstY, int radius, PhotoWindow& window)
{
  const int side = 2 * radius + 1;
  const int columns = ColumnsOf(radius);
  window.AllObject = AllObject(view, firstX, firstY, side);
  for (int row = 0; row < side && !window.AllObject; ++row)
  {
    float* object = window.Object + row * columns;
    for (int i = 0; i < side; ++i)
    {
      const bool is =
        view.Mask.Contains(firstX + i, firstY + row) && view.IsObject(firstX + i, firstY + row);
      object[3 * i] = object[3 * i + 1] = object[3 * i + 2] = is ? 1.f : 0.f;
    }
    std::fill(object + 3 * side, object + columns, 0.f);
  }
}

/** Reads the window around a position between pixels. */
void ReadWindow(const View& view, const Vector2d& centre, int radius, PhotoWindow& window)
{
  const ImageRef<const std::uint8_t>& image = view.Color;
  const int side = 2 * radius + 1;
  const int firstX = FloorToInt(centre.x()) - radius;
  const int firstY = FloorToInt(centre.y()) - radius;
  const auto fx = static_cast<float>(centre.x() - std::floor(centre.x()));
  const auto fy = static_cast<float>(centre.y() - std::floor(centre.y()));
  ReadObject(view, firstX + (fx >= 0.5f ? 1 : 0), firstY + (fy >= 0.5f ? 1 : 0), radius, window);
  const int columns = ColumnsOf(radius);
  if (firstX >= 0 && firstY >= 0 && 3 * (image.Width - firstX) >= columns + 3 &&
    firstY + side < image.Height)
  {
    Interpolate(image.Pixel(firstX, firstY), image.RowStride, fx, fy, side, columns, window.Values);
  }
  else
  {
    InterpolateAtBorder(image, firstX, firstY, fx, fy, radius, columns, window.Values);
  }
}

/** Sums over the values of two windows that are object in both. */
struct WindowSums
{
  float A[PhotoWindow::MaxColumns]; ///< by column
  float B[PhotoWindow::MaxColumns];
  float One[PhotoWindow::MaxColumns];
  float AA[Block]; ///< by column modulo Block
  float BB[Block];
  float AB[Block];
};

template <bool Masked>
[[gnu::always_inline]] inline void AddUp(
  const PhotoWindow& a, const PhotoWindow& b, int rows, int columns, WindowSums& sums)
{
  // The one that is all object has nothing to add to the other's selection.
  const float* inA = a.AllObject ? b.Object : a.Object;
  const float* inB = b.AllObject ? a.Object : b.Object;
  Floats aa{};
  Floats bb{};
  Floats ab{};
  for (int first = 0; first < columns; first += Block)
  {
    Floats used; // what fills the last block is not
    for (int i = 0; i < Block; ++i)
    {
      used[i] = first + i < 3 * rows ? 1.f : 0.f;
    }
    Floats sumA{};
    Floats sumB{};
    Floats sumOne{};
    for (int at = first; at < rows * columns; at += columns)
    {
      Floats x;
      Floats y;
      std::memcpy(&x, a.Values + at, sizeof(x));
      std::memcpy(&y, b.Values + at, sizeof(y));
      x *= used;
      y *= used;
      if (Masked)
      {
        Floats one;
        Floats other;
        std::memcpy(&one, inA + at, sizeof(one));
        std::memcpy(&other, inB + at, sizeof(other));
        one *= other;
        x *= one;
        y *= one;
        sumOne += one;
      }
      sumA += x;
      sumB += y;
      aa += x * x;
      bb += y * y;
      ab += x * y;
    }
    std::memcpy(sums.A + first, &sumA, sizeof(Floats));
    std::memcpy(sums.B + first, &sumB, sizeof(Floats));
    std::memcpy(sums.One + first, &sumOne, sizeof(Floats));
  }
  std::memcpy(sums.AA, &aa, sizeof(Floats));
  std::memcpy(sums.BB, &bb, sizeof(Floats));
  std::memcpy(sums.AB, &ab, sizeof(Floats));
}

NOVELVIEW_CLONES void AddUpAll(
  const PhotoWindow& a, const PhotoWindow& b, int rows, int columns, WindowSums& sums)
{
  AddUp<false>(a, b, rows, columns, sums);
}

NOVELVIEW_CLONES void AddUpObject(
  const PhotoWindow& a, const PhotoWindow& b, int rows, int columns, WindowSums& sums)
{
  AddUp<true>(a, b, rows, columns, sums);
}

/** What there is to know of two windows together. */
struct WindowPair
{
  double A[3] = {}; ///< sums by channel
  double B[3] = {};
  double AA = 0; ///< sums of products
  double BB = 0;
  double AB = 0;
  double Pixels = 0; ///< that count

  WindowPair(const PhotoWindow& a, const PhotoWindow& b, int radius)
  {
    const int side = 2 * radius + 1;
    const bool all = a.AllObject && b.AllObject;
    WindowSums sums;
    (all ? AddUpAll : AddUpObject)(a, b, side, ColumnsOf(radius), sums);
    for (int i = 0; i < 3 * side; i += 3)
    {
      for (int channel = 0; channel < 3; ++channel)
      {
        this->A[channel] += sums.A[i + channel];
        this->B[channel] += sums.B[i + channel];
      }
      this->Pixels += all ? side : sums.One[i];
    }
    for (int i = 0; i < Block; ++i)
    {
      this->AA += sums.AA[i];
      this->BB += sums.BB[i];
      this->AB += sums.AB[i];
    }
  }

  /** Makes the sums of products those of the values less their channels' means. */
  void SubtractMeans()
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      this->AA -= this->A[channel] * this->A[channel] / this->Pixels;
      this->BB -= this->B[channel] * this->B[channel] / this->Pixels;
      this->AB -= this->A[channel] * this->B[channel] / this->Pixels;
    }
  }
};

bool TooFew(double pixels, int radius)
{
  const int side = 2 * radius + 1;
  return 4 * pixels < side * side;
}
}

WindowMatcher::WindowMatcher(const View& key, const Vector2d& keyCentre, int radius)
  : Radius(std::min(radius, PhotoWindow::MaxRadius))
{
  ReadWindow(key, keyCentre, this->Radius, this->Key);
}

double WindowMatcher::Difference(const View& other, const Vector2d& otherCentre) const
{
  PhotoWindow window;
  ReadWindow(other, otherCentre, this->Radius, window);
  const WindowPair sums(this->Key, window, this->Radius);
  if (TooFew(sums.Pixels, this->Radius))
  {
    return 1;
  }
  const double squares = std::max(sums.AA - 2 * sums.AB + sums.BB, 0.0);
  const double power = std::sqrt(sums.AA * sums.BB);
  return power > 0 ? std::min(squares / power, 1.0) : (squares > 0 ? 1 : 0);
}

double WindowMatcher::Similarity(const View& other, const Vector2d& otherCentre, double noise) const
{
  PhotoWindow window;
  ReadWindow(other, otherCentre, this->Radius, window);
  WindowPair sums(this->Key, window, this->Radius);
  if (TooFew(sums.Pixels, this->Radius))
  {
    return 0;
  }
  sums.SubtractMeans();
  const double floor = 3 * sums.Pixels * noise;
  return std::max(sums.AB, 0.0) / std::sqrt((sums.AA + floor) * (sums.BB + floor));
}

double WindowMatcher::ContrastDifference(
  const View& other, const Vector2d& otherCentre, double noise) const
{
  PhotoWindow window;
  ReadWindow(other, otherCentre, this->Radius, window);
  WindowPair sums(this->Key, window, this->Radius);
  if (TooFew(sums.Pixels, this->Radius))
  {
    return 1;
  }
  sums.SubtractMeans();
  const double floor = 3 * sums.Pixels * noise;
  const double squares = std::max(sums.AA - 2 * sums.AB + sums.BB, 0.0);
  return std::min(squares / (2 * std::sqrt((sums.AA + floor) * (sums.BB + floor))), 1.0);
}

double WindowMatcher::Variance() const
{
  WindowPair sums(this->Key, this->Key, this->Radius);
  if (TooFew(sums.Pixels, this->Radius))
  {
    return 0;
  }
  sums.SubtractMeans();
  return std::max(sums.AA, 0.0) / (3 * sums.Pixels);
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
