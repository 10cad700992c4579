// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo/PhotoConsistency.h"
#include "support/Expect.h"
#include "support/Scene.h"

using namespace novelview;
using namespace support;

namespace
{
/** A photograph of 16 x 16 pixels that is all object. */
struct Picture
{
  explicit Picture(const std::function<double(int x, int y)>& grey)
  {
    for (int y = 0; y < 16; ++y)
    {
      for (int x = 0; x < 16; ++x)
      {
        for (int channel = 0; channel < 3; ++channel)
        {
          this->Color(x, y, channel) = static_cast<std::uint8_t>(grey(x, y));
        }
      }
    }
  }
  View AsView() const
  {
    View view;
    view.Color = this->Color.Ref();
    view.Mask = this->Mask.Ref();
    return view;
  }
  Image<std::uint8_t> Color{ 16, 16, 3 };
  Image<std::uint8_t> Mask{ 16, 16, 1, 255 };
};

const Vector2d Middle(8, 8);

double Difference(const View& key, const Vector2d& keyCentre, const View& other,
  const Vector2d& otherCentre, int radius)
{
  return WindowMatcher(key, keyCentre, radius).Difference(other, otherCentre);
}
}

TEST(PhotoConsistency, DifferenceOfConstantWindows)
{
  const Picture a([](int, int) { return 100; });
  const Picture b([](int, int) { return 50; });
  const Picture black([](int, int) { return 0; });
  // n (100 - 50)^2 / sqrt(n 100^2 n 50^2) = 0.5 whatever n.
  EXPECT_DOUBLE_EQ(Difference(a.AsView(), Middle, b.AsView(), Middle, 2), 0.5);
  EXPECT_DOUBLE_EQ(Difference(a.AsView(), Middle, a.AsView(), Middle, 2), 0);
  EXPECT_DOUBLE_EQ(Difference(black.AsView(), Middle, black.AsView(), Middle, 2), 0);
  EXPECT_DOUBLE_EQ(Difference(a.AsView(), Middle, black.AsView(), Middle, 2), 1);
}

TEST(PhotoConsistency, DifferenceCountsOnlyPixelsThatAreObjectInBoth)
{
  const Picture a([](int, int) { return 100; });
  Picture b([](int x, int) { return x < 8 ? 100 : 20; });
  EXPECT_GT(Difference(a.AsView(), Middle, b.AsView(), Middle, 2), 0.1);
  for (int y = 0; y < 16; ++y)
  {
    for (int x = 8; x < 16; ++x)
    {
      b.Mask(x, y) = 127; // just not object
    }
  }
  EXPECT_DOUBLE_EQ(Difference(a.AsView(), Middle, b.AsView(), Middle, 2), 0);
  // At x = 10 the 5 x 5 window from 8 to 12 has nothing left, at 9 a fifth: less than a quarter.
  EXPECT_DOUBLE_EQ(Difference(a.AsView(), Middle, b.AsView(), Vector2d(9, 8), 2), 1);
}

TEST(PhotoConsistency, DifferenceByHandOnARamp)
{
  const Picture a([](int x, int) { return 10 * x; });
  // Windows of 3 x 3 about x = 2 and x = 3: 10, 20, 30 against 20, 30, 40 in each row.
  const double expected = 3 * 100 / std::sqrt((1. + 4 + 9) * (4 + 9 + 16) * 100 * 100);
  EXPECT_NEAR(
    Difference(a.AsView(), Vector2d(2, 5), a.AsView(), Vector2d(3, 5), 1), expected, 1e-12);
  // Half a pixel is interpolated: 15, 25, 35.
  const double half = 3 * 25 / std::sqrt((1. + 4 + 9) * (2.25 + 6.25 + 12.25) * 100 * 100);
  EXPECT_NEAR(Difference(a.AsView(), Vector2d(2, 5), a.AsView(), Vector2d(2.5, 5), 1), half, 1e-12);
}

TEST(PhotoConsistency, AWindowLargerThanTheLargestDoesNotOverrunItsBuffer)
{
  const Picture a([](int x, int) { return 10 * x; });
  const Picture b([](int, int y) { return 10 * y; });
  EXPECT_EQ(Difference(a.AsView(), Middle, b.AsView(), Middle, 40),
    Difference(a.AsView(), Middle, b.AsView(), Middle, 7));
  EXPECT_EQ(WindowMatcher(a.AsView(), Middle, 40).Similarity(b.AsView(), Middle),
    WindowMatcher(a.AsView(), Middle, 7).Similarity(b.AsView(), Middle));
}

TEST(PhotoConsistency, SimilarityIsBlindToBrightnessAndContrast)
{
  const Picture a([](int x, int y) { return 20 + (x * 7 + y * 13) % 90; });
  const Picture brighter([](int x, int y) { return 60 + 2 * ((x * 7 + y * 13) % 90); });
  const Picture inverse([](int x, int y) { return 200 - (x * 7 + y * 13) % 90; });
  const Picture flat([](int, int) { return 100; });
  const WindowMatcher matcher(a.AsView(), Middle, 3);
  // The noise term of 12 against variances of some 600 costs two percent.
  EXPECT_GT(matcher.Similarity(a.AsView(), Middle), 0.97);
  EXPECT_GT(matcher.Similarity(brighter.AsView(), Middle), 0.97);
  EXPECT_EQ(matcher.Similarity(inverse.AsView(), Middle), 0);
  EXPECT_EQ(matcher.Similarity(flat.AsView(), Middle), 0);
  EXPECT_LE(matcher.Similarity(a.AsView(), Middle, 0), 1 + 1e-12);
}

TEST(PhotoConsistency, ContrastDifferenceByHandOnARamp)
{
  const Picture a([](int x, int) { return 10 * x; });
  const Picture brighter([](int x, int) { return 10 * x + 50; });
  const Picture steeper([](int x, int) { return std::max(20 * x - 80, 0); });
  const Picture flat([](int, int) { return 100; });
  const WindowMatcher matcher(a.AsView(), Middle, 1);
  EXPECT_NEAR(matcher.ContrastDifference(brighter.AsView(), Middle, 0), 0, 1e-12);
  // Less the means -10, 0, 10 against -20, 0, 20 in each of three rows: 600 / (2 sqrt(600 . 2400)).
  EXPECT_NEAR(matcher.ContrastDifference(steeper.AsView(), Middle, 0), 0.25, 1e-12);
  // Three channels of nine pixels, noise of 108 per channel: 200 in the middle, 600 at the sides.
  EXPECT_NEAR(matcher.ContrastDifference(brighter.AsView(), Middle, 12), 0, 1e-12);
  EXPECT_NEAR(matcher.ContrastDifference(steeper.AsView(), Middle, 12),
    600 / (2 * std::sqrt((600. + 108) * (2400 + 108))), 1e-12);
  EXPECT_EQ(matcher.ContrastDifference(flat.AsView(), Middle), 1) << "cut at the worst";
  EXPECT_EQ(matcher.ContrastDifference(a.AsView(), Vector2d(40, 8)), 1) << "outside the frame";
}

TEST(PhotoConsistency, VarianceTellsHowMuchAWindowCanTell)
{
  const Picture a([](int x, int) { return 10 * x; });
  const Picture flat([](int, int) { return 100; });
  EXPECT_NEAR(WindowMatcher(a.AsView(), Middle, 1).Variance(), 200. / 3, 1e-9);
  EXPECT_EQ(WindowMatcher(flat.AsView(), Middle, 1).Variance(), 0);
  EXPECT_EQ(WindowMatcher(a.AsView(), Vector2d(40, 8), 1).Variance(), 0);
}

TEST(PhotoConsistency, SimilarityOfAWindowOutsideTheObjectIsNothing)
{
  Picture a([](int x, int y) { return 20 + (x * 7 + y * 13) % 90; });
  const WindowMatcher matcher(a.AsView(), Middle, 3);
  EXPECT_EQ(matcher.Similarity(a.AsView(), Vector2d(40, 8)), 0);
  a.Mask = Image<std::uint8_t>(16, 16);
  EXPECT_EQ(matcher.Similarity(a.AsView(), Middle), 0);
}

TEST(PhotoConsistency, TriangulationFindsThePointBothSee)
{
  const Camera key = OnRing(0);
  const Camera other = OnRing(30, 10);
  const Vector3d point(0.1, -0.2, 0.3);
  Vector3d found;
  ASSERT_TRUE(Triangulate(key, key.Project(point), other, other.Project(point), found));
  EXPECT_LT((found - point).norm(), 1e-12);
  EXPECT_FALSE(Triangulate(key, Vector2d(80, 60), key, Vector2d(80, 60), found)) << "parallel";
}

TEST(PhotoConsistency, TriangulationStaysOnTheKeyRay)
{
  const Camera key = OnRing(0);
  const Camera other = OnRing(30);
  const Vector2d keyPixel(90, 50);
  Vector3d found;
  ASSERT_TRUE(Triangulate(key, keyPixel, other, Vector2d(85, 53), found)); // the rays are skew
  EXPECT_LT((key.Project(found) - keyPixel).norm(), 1e-9);
}

TEST(PhotoConsistency, RaysThatMeetBehindACameraAreNoMatch)
{
  const Camera key = OnRing(0);
  Camera other = OnRing(0);
  other.T.x() -= 1; // a metre to the right, the same direction
  Vector3d found;
  EXPECT_TRUE(Triangulate(key, Vector2d(90, 60), other, Vector2d(70, 60), found));
  EXPECT_FALSE(Triangulate(key, Vector2d(70, 60), other, Vector2d(90, 60), found));
}
