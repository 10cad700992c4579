// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/AtomicFile.h"
#include "core/Error.h"
#include "dataset/Dataset.h"
#include "images/ImageFile.h"
#include "masks/Coverage.h"
#include "masks/Silhouette.h"
#include "silhouettes/ContourDistance.h"
#include "support/TemporaryFolder.h"
#include "support/TestSupport.h"

#include <array>
#include <cmath>
#include <functional>
#include <random>

using namespace novelview;
using namespace novelview::testing_support;

namespace
{
using Colour = std::array<double, 3>;
constexpr int Width = 160;
constexpr int Height = 120;

/** What is seen at a point: a colour, and whether that is the object. */
struct Seen
{
  Colour Rgb;
  bool Object = false;
};
using Scene = std::function<Seen(double x, double y)>;

struct Photo
{
  Image<std::uint8_t> Rgb{ Width, Height, 3 };
  Image<std::uint8_t> Truth{ Width, Height };
};

/** A photograph with 4 x 4 samples per pixel and normal noise of 1.5 levels. */
Photo Take(const Scene& scene)
{
  Photo photo;
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 1.5);
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      Colour sum{ 0, 0, 0 };
      int hits = 0;
      for (int s = 0; s < 16; ++s)
      {
        const Seen seen = scene(x + (s % 4 - 1.5) / 4, y + (s / 4 - 1.5) / 4);
        hits += seen.Object;
        for (int c = 0; c < 3; ++c)
        {
          sum[c] += seen.Rgb[c] / 16;
        }
      }
      photo.Truth(x, y) = hits >= 8 ? 255 : 0;
      for (int c = 0; c < 3; ++c)
      {
        photo.Rgb(x, y, c) =
          static_cast<std::uint8_t>(std::lround(std::clamp(sum[c] + noise(random), 0.0, 255.0)));
      }
    }
  }
  return photo;
}

/** A grey ball lit from the upper left: from bright to nearly as dark as the background. */
Seen GreyBall(double x, double y, double centreX)
{
  const double u = (x - centreX) / 40;
  const double v = (y - 60) / 40;
  if (u * u + v * v > 1)
  {
    return { { 6, 6, 8 }, false };
  }
  const double w = std::sqrt(1 - u * u - v * v);
  const double light = 24 + 190 * std::max(0.0, -0.6 * u - 0.5 * v + 0.62 * w);
  return { { light, light, light }, true };
}
}

TEST(Silhouette, KeepsThePartsOfAnObjectThatLieInShadow)
{
  const Photo photo = Take([](double x, double y) { return GreyBall(x, y, 80); });
  const Image<std::uint8_t> mask = ExtractSilhouette(photo.Rgb.Ref());
  // The circumference is 250 of 5000 pixels: half a pixel all around would cost 2.5 %.
  EXPECT_GT(IouOf(mask, photo.Truth), 0.985);
  // The case is a hard one: halfway between background and object loses a lot of the ball.
  SilhouetteOptions halfway;
  halfway.Level = 100;
  EXPECT_LT(IouOf(ExtractSilhouette(photo.Rgb.Ref(), halfway), photo.Truth), 0.8);
}

TEST(Silhouette, FindsTheHalfOfAnObjectThatAShadowAllButBlackens)
{
  // Below the shadow's soft edge the ball is three levels above the background, two sigmas of the
  // noise: no threshold on single pixels can find it.
  const Photo photo = Take(
    [](double x, double y)
    {
      const bool ball = std::hypot(x - 80, y - 60) < 40;
      const double light = 9 + 150 * std::clamp((62 + 0.2 * x - y) / 6, 0.0, 1.0);
      return Seen{ ball ? Colour{ light, light, light } : Colour{ 6, 6, 6 }, ball };
    });
  // The dark half's boundary is known to about a pixel, 125 of 5000.
  EXPECT_GT(IouOf(ExtractSilhouette(photo.Rgb.Ref()), photo.Truth), 0.95);
}

TEST(Silhouette, OfAnObjectThatLeavesTheFrameReachesTheFrame)
{
  const Photo photo = Take([](double x, double y) { return GreyBall(x, y, 5); });
  const Image<std::uint8_t> mask = ExtractSilhouette(photo.Rgb.Ref());
  EXPECT_GT(IouOf(mask, photo.Truth), 0.98); // as above, on half the area
  const Coverage coverage = MeasureCoverage(mask.Ref());
  EXPECT_TRUE(coverage.Left);
  EXPECT_FALSE(coverage.Right || coverage.Top || coverage.Bottom);
  const std::vector<std::string> words = CheckCoverage(coverage, "view a.png");
  ASSERT_EQ(words.size(), 1u);
  EXPECT_THAT(words[0], testing::HasSubstr("view a.png: the object leaves the frame (left)"));
}

TEST(Silhouette, RimIsTheHalfHeightOfTheEdgeNotItsFoot)
{
  // An evenly bright disc: the low level alone would put the boundary some 0.4 px outside.
  const auto disc = [](double x, double y) { return 35.3 - std::hypot(x - 80.2, y - 59.7); };
  const Photo photo = Take(
    [&disc](double x, double y)
    {
      const bool inside = disc(x, y) > 0;
      return Seen{ inside ? Colour{ 200, 180, 150 } : Colour{ 5, 5, 5 }, inside };
    });
  const Image<float> distance = SignedContourDistance(ExtractSilhouette(photo.Rgb.Ref()).Ref());
  double sum = 0;
  double squares = 0;
  int count = 0;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      if (std::abs(disc(x, y)) < 3)
      {
        const double error = distance(x, y) - disc(x, y);
        sum += error;
        squares += error * error;
        ++count;
      }
    }
  }
  // 16 samples and noise of 1.5 of 200 levels leave a few hundredths of a pixel.
  EXPECT_LT(std::abs(sum / count), 0.05);
  EXPECT_LT(std::sqrt(squares / count), 0.1);
}

TEST(Silhouette, IgnoresTheCastShadowOnAColouredBackground)
{
  // A grey box on blue, its shadow to the right of it.
  const Photo photo = Take(
    [](double x, double y)
    {
      const bool box = std::abs(x - 59.8) < 25 && std::abs(y - 60.3) < 30;
      const bool shadow = std::abs(x - 100) < 30 && std::abs(y - 70) < 25;
      const Colour ground = shadow ? Colour{ 20, 40, 90 } : Colour{ 40, 80, 180 };
      return Seen{ box ? Colour{ 150, 150, 150 } : ground, box };
    });
  EXPECT_GT(
    IouOf(ExtractSilhouette(photo.Rgb.Ref()), photo.Truth), 0.97); // 3 % = half the boundary
  SilhouetteOptions without;
  without.IgnoreShadows = false;
  EXPECT_LT(IouOf(ExtractSilhouette(photo.Rgb.Ref(), without), photo.Truth), 0.8);
}

TEST(Silhouette, FillsSpecksButKeepsRealHoles)
{
  const Photo photo = Take(
    [](double x, double y)
    {
      const double r = std::hypot(x - 80, y - 60);
      const bool speck = std::hypot(x - 80, y - 30) < 1.5;
      const bool ring = r < 45 && r > 15;
      const bool crumb = std::hypot(x - 20, y - 20) < 4;
      const bool bright = (ring && !speck) || crumb;
      return Seen{ bright ? Colour{ 220, 120, 60 } : Colour{ 30, 90, 40 }, ring };
    });
  const Image<std::uint8_t> mask = ExtractSilhouette(photo.Rgb.Ref());
  EXPECT_GT(mask(80, 30), 127) << "the speck in the ring";
  EXPECT_LT(mask(80, 60), 128) << "the hole of the ring";
  EXPECT_LT(mask(20, 20), 128) << "the crumb beside it";
  EXPECT_GT(IouOf(mask, photo.Truth), 0.97); // half the boundary
}

namespace
{
/** The mask's picture before a background of one grey, as JPEG of this quality, and read again. */
Image<std::uint8_t> CutOutAsJpeg(const Photo& photo, std::uint8_t background, int quality)
{
  Image<std::uint8_t> cut = photo.Rgb;
  for (std::size_t i = 0; i < photo.Truth.Values.size(); ++i)
  {
    if (photo.Truth.Values[i] == 0)
    {
      std::fill_n(cut.Values.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, background);
    }
  }
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> jpeg = EncodeJpeg(cut.Ref(), quality, "cut-out");
  WriteTextAtomically(
    folder / "a.jpg", { reinterpret_cast<const char*>(jpeg.data()), jpeg.size() });
  return ReadColorFile(folder / "a.jpg");
}
}

TEST(Silhouette, RingingOfAJpegAroundACutOutIsNoObject)
{
  // Lossless, the border is exactly of one colour: no noise to be seen there.
  const Photo photo = Take(
    [](double x, double y)
    {
      const double light = 0.75 + 0.25 * std::sin(0.9 * x + 0.3 * y);
      return Seen{ { 210 * light, 150 * light, 90 * light }, std::hypot(x - 80, y - 60) < 40 };
    });
  for (const int background : { 0, 20, 40, 255 })
  {
    for (const int quality : { 75, 80, 85, 90, 95 })
    {
      const auto jpeg = CutOutAsJpeg(photo, static_cast<std::uint8_t>(background), quality);
      // 1.5 % are a third of a pixel along the circumference.
      EXPECT_GT(IouOf(ExtractSilhouette(jpeg.Ref()), photo.Truth), 0.985)
        << "background " << background << ", quality " << quality;
    }
  }
}

TEST(Silhouette, NothingInThePictureIsAnError)
{
  const Image<std::uint8_t> photo(Width, Height, 3, 9);
  const Image<std::uint8_t> mask = ExtractSilhouette(photo.Ref());
  ExpectError([&] { CheckCoverage(MeasureCoverage(mask.Ref()), "view dark.png"); }, "view dark.png",
    "silhouette is empty");
  const Image<std::uint8_t> full(Width, Height, 1, 255);
  ExpectError([&] { CheckCoverage(MeasureCoverage(full.Ref()), "view b.png"); }, "view b.png",
    "fills the whole frame");
}

TEST(Silhouette, AgreesWithTheMasksOfTheTemple)
{
  const std::filesystem::path temple = SharedFolder() / "data" / "templeSparseRing";
  if (!std::filesystem::exists(temple / "mask"))
  {
    GTEST_SKIP() << "needs the Middlebury data set templeSparseRing with masks in " << temple;
  }
  for (const char* name : { "templeSR0001.png", "templeSR0007.png", "templeSR0012.png" })
  {
    const Image<std::uint8_t> mask = ExtractSilhouette(ReadColorFile(temple / name).Ref());
    // Those masks are extracted ones, too, with corners of the backdrop in them; a pixel along the
    // temple's long outline is 3 %.
    EXPECT_GT(IouOf(mask, ReadGreyFile(temple / "mask" / name)), 0.93) << name;
  }
}
