// SPDX-License-Identifier: GPL-3.0-or-later
#include "silhouettes/ContourDistance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace novelview;

namespace
{
using Field = std::function<double(double x, double y)>;

/** Coverage of the set field > 0, by n x n samples per pixel (1: binary, at the pixel's centre). */
Image<std::uint8_t> Draw(int width, int height, int n, const Field& field)
{
  Image<std::uint8_t> mask(width, height);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      int hits = 0;
      for (int s = 0; s < n * n; ++s)
      {
        const double dx = (s % n + 0.5) / n - 0.5;
        const double dy = (s / n + 0.5) / n - 0.5;
        hits += field(x + dx, y + dy) > 0;
      }
      mask(x, y) = static_cast<std::uint8_t>(std::lround(255.0 * hits / (n * n)));
    }
  }
  return mask;
}

struct Deviation
{
  double Max = 0;
  double Rms = 0;
  double Mean = 0;
};

/** Deviation from the true field over the pixels with a true distance in [from, to]. */
Deviation Compare(const Image<float>& distance, const Field& field, double from, double to)
{
  Deviation result;
  double count = 0;
  for (int y = 0; y < distance.Height; ++y)
  {
    for (int x = 0; x < distance.Width; ++x)
    {
      const double truth = field(x, y);
      if (std::abs(truth) >= from && std::abs(truth) <= to)
      {
        const double error = distance(x, y) - truth;
        result.Max = std::max(result.Max, std::abs(error));
        result.Rms += error * error;
        result.Mean += error;
        count += 1;
      }
    }
  }
  EXPECT_GT(count, 0);
  result.Rms = std::sqrt(result.Rms / count);
  result.Mean /= count;
  return result;
}

double Circle(double x, double y)
{
  return 40.3 - std::hypot(x - 61.2, y - 58.7);
}
}

TEST(ContourDistance, AStraightBinaryEdgeIsTheSideOfThePixels)
{
  const Field edge = [](double x, double) { return x - 9.5; };
  const Image<float> distance = SignedContourDistance(Draw(30, 12, 1, edge).Ref());
  for (int y = 0; y < 12; ++y)
  {
    for (int x = 0; x < 30; ++x)
    {
      // Exact numbers: the side lies at 9.5, and nothing happens at the frame.
      EXPECT_FLOAT_EQ(distance(x, y), static_cast<float>(x - 9.5)) << x << " " << y;
    }
  }
}

TEST(ContourDistance, SeesASlantedSoftEdgeToAFiftiethOfAPixel)
{
  for (int angleDeg = 0; angleDeg < 360; angleDeg += 15)
  {
    const double a = (angleDeg + 3) * 3.14159265358979 / 180;
    // Beyond 18 px from the middle the nearest point of the edge may lie outside the frame.
    const auto offset = [a](double x, double y)
    { return (x - 24.37) * std::cos(a) + (y - 25.81) * std::sin(a); };
    const Field edge = [&offset](double x, double y)
    { return std::hypot(x - 24.5, y - 24.5) < 18 ? offset(x, y) : 1e9; };
    const Image<float> distance = SignedContourDistance(Draw(50, 50, 16, offset).Ref());
    // 255 levels and 16 x 16 samples place a straight edge to about 0.01 px.
    EXPECT_LT(Compare(distance, edge, 0, 15).Rms, 0.02) << angleDeg;
    EXPECT_LT(Compare(distance, edge, 0, 15).Max, 0.1) << angleDeg;
  }
}

TEST(ContourDistance, OfASoftCircleIsSubPixel)
{
  const Image<float> distance = SignedContourDistance(Draw(120, 120, 16, Circle).Ref());
  const Deviation rim = Compare(distance, Circle, 0, 5);
  EXPECT_LT(rim.Max, 0.1);
  EXPECT_LT(rim.Rms, 0.02);
  // Away from the boundary the hand-me-down search may miss the nearest segment for a neighbour of
  // it.
  EXPECT_LT(Compare(distance, Circle, 5, 200).Max, 0.1);
}

TEST(ContourDistance, OfABinaryCircleIsHalfAPixel)
{
  const Image<float> distance = SignedContourDistance(Draw(120, 120, 1, Circle).Ref());
  const Deviation rim = Compare(distance, Circle, 0, 5);
  // A pixel is in or out by its centre, so the contour is known to about half a pixel.
  EXPECT_LT(rim.Max, 0.6);
  EXPECT_LT(rim.Rms, 0.35);
  // It must not be biased: object and background are treated alike.
  EXPECT_LT(std::abs(rim.Mean), 0.05);
}

TEST(ContourDistance, OfABlurredEdgeIsItsHalfHeight)
{
  const Field edge = [](double x, double) { return x - 20.3; };
  Image<std::uint8_t> mask(40, 8);
  for (int y = 0; y < 8; ++y)
  {
    for (int x = 0; x < 40; ++x)
    {
      // A linear ramp four pixels wide, symmetric about the edge.
      mask(x, y) =
        static_cast<std::uint8_t>(std::lround(255 * std::clamp(0.5 + (x - 20.3) / 4, 0.0, 1.0)));
    }
  }
  // 8-bit rounding of four ramp pixels: 4 * 0.5 / 255.
  EXPECT_LT(Compare(SignedContourDistance(mask.Ref()), edge, 0, 15).Max, 0.01);
}

TEST(ContourDistance, InsideAndOutsideAreMirrorImages)
{
  const Image<std::uint8_t> mask = Draw(90, 70, 4,
    [](double x, double y) { return 20 + 5 * std::sin(0.3 * x) - std::hypot(x - 45, y - 35); });
  Image<std::uint8_t> negative = mask;
  for (std::uint8_t& value : negative.Values)
  {
    value = static_cast<std::uint8_t>(255 - value);
  }
  const Image<float> distance = SignedContourDistance(mask.Ref());
  const Image<float> mirrored = SignedContourDistance(negative.Ref());
  for (std::size_t i = 0; i < distance.Values.size(); ++i)
  {
    EXPECT_NEAR(distance.Values[i], -mirrored.Values[i], 1e-4); // float rounding of c and 1 - c
    EXPECT_TRUE(distance.Values[i] == 0 || (distance.Values[i] > 0) == (mask.Values[i] > 127));
  }
}

TEST(ContourDistance, AThinGapHasAContourOnBothSides)
{
  const Field gap = [](double x, double) { return std::abs(x - 10) - 0.5; };
  const Image<float> distance = SignedContourDistance(Draw(21, 9, 1, gap).Ref());
  EXPECT_FLOAT_EQ(distance(9, 4), 0.5F);
  EXPECT_FLOAT_EQ(distance(10, 4), -0.5F);
  EXPECT_FLOAT_EQ(distance(11, 4), 0.5F);
}

TEST(ContourDistance, TheFrameIsNoContour)
{
  // An object that leaves the frame on the left: distances there are those to the drawn edge.
  const Field edge = [](double x, double) { return 12.5 - x; };
  EXPECT_FLOAT_EQ(SignedContourDistance(Draw(30, 10, 1, edge).Ref())(0, 0), 12.5F);
  const Image<float> full = SignedContourDistance(Image<std::uint8_t>(30, 40, 1, 255).Ref());
  const Image<float> empty = SignedContourDistance(Image<std::uint8_t>(30, 40, 1, 0).Ref());
  EXPECT_FLOAT_EQ(full(3, 3), 50.0F);
  EXPECT_FLOAT_EQ(empty(3, 3), -50.0F);
}

TEST(ContourDistance, FarDistancesAreThoseOfTheBruteForceSearch)
{
  // Two specks: the nearest one changes in between, where chamfer transforms go wrong.
  Image<std::uint8_t> mask(150, 110);
  mask(20, 15) = 255;
  mask(130, 90) = 255;
  const Image<float> distance = SignedContourDistance(mask.Ref());
  for (int y = 0; y < 110; ++y)
  {
    for (int x = 0; x < 150; ++x)
    {
      const double centre = std::min(std::hypot(x - 20, y - 15), std::hypot(x - 130, y - 90));
      if (centre > 2)
      {
        // The contour of a single pixel lies 0.35 to 0.5 px from its centre.
        EXPECT_LT(-distance(x, y), centre - 0.35 + 1e-4) << x << " " << y;
        EXPECT_GT(-distance(x, y), centre - 0.5 - 1e-4) << x << " " << y;
      }
    }
  }
}
