// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ImageRef.h"
#include "core/ToInt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>

using namespace novelview;

namespace
{
constexpr double Huge = 1e308;
constexpr double Infinite = std::numeric_limits<double>::infinity();
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr int Limit = 1 << 30;
}

TEST(ToInt, IsThePlainCastOfWhateverAFrameHolds)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-1e6, 1e6);
  for (int i = 0; i < 1000; ++i)
  {
    const double value = i % 2 == 0 ? anywhere(random) : std::round(2 * anywhere(random)) / 2;
    EXPECT_EQ(ToInt(value), static_cast<int>(value)) << value;
    EXPECT_EQ(FloorToInt(value), static_cast<int>(std::floor(value))) << value;
    EXPECT_EQ(CeilToInt(value), static_cast<int>(std::ceil(value))) << value;
    EXPECT_EQ(RoundToInt(value), static_cast<int>(std::lround(value))) << value;
  }
}

TEST(ToInt, SaturatesWhereNoIntHoldsTheNumber)
{
  for (const double value : { Huge, Infinite, 2147483648.0 })
  {
    EXPECT_EQ(ToInt(value), Limit);
    EXPECT_EQ(FloorToInt(-value), -Limit);
    EXPECT_EQ(CeilToInt(value), Limit);
    EXPECT_EQ(RoundToInt(-value), -Limit);
  }
  EXPECT_EQ(ToInt(NaN), -Limit);
  EXPECT_EQ(RoundToInt(NaN), -Limit);
}

TEST(ToInt, ClampingANaNGivesTheLowerEnd)
{
  EXPECT_EQ(ClampedNumber(NaN, 2, 5), 2);
  EXPECT_EQ(ClampedNumber(-Huge, 2, 5), 2);
  EXPECT_EQ(ClampedNumber(Infinite, 2, 5), 5);
  EXPECT_EQ(ClampedNumber(3.5, 2, 5), 3.5);
}

TEST(SampleBilinear, PositionsThatAreNoPixelsReadNoOtherMemory)
{
  Image<float> image(2, 2);
  image.Values = { 1, 2, 3, 4 };
  const ImageRef<const float> pixels = std::as_const(image).Ref();
  EXPECT_EQ(SampleBilinear(pixels, NaN, NaN), 1);
  EXPECT_EQ(SampleBilinear(pixels, Huge, -Huge), 2);
  EXPECT_EQ(SampleBilinear(pixels, -Infinite, Infinite), 3);
  EXPECT_EQ(SampleBilinear(pixels, 0.5, 0.5), 2.5);
}
