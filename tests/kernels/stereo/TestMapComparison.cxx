// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo/MapComparison.h"
#include "support/Expect.h"
#include "support/Scene.h"

#include <numeric>

using namespace novelview;
using namespace support;

namespace
{
constexpr double Footprint = 0.01; ///< 4 units away, focal length 400

/** Views with their true depth maps, all of them trusted. */
struct Scene
{
  explicit Scene(std::vector<Photo> photos)
    : Photos(std::move(photos))
    , Confidence(Photos[0].Cam.Width, Photos[0].Cam.Height, 1, 1.f)
  {
  }
  std::vector<View> Views() const
  {
    std::vector<View> views = ViewsOf(this->Photos);
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      views[i].DepthMap = this->Photos[i].TrueDepth.Ref();
      views[i].Confidence = this->Confidence.Ref();
    }
    return views;
  }
  std::vector<Photo> Photos;
  Image<float> Confidence;
};

const Scene& WavyBall()
{
  static const Scene scene(TakeAll(Sphere(Vector3d::Zero(), 0.5), Waves(0.4), Ring(12, 30)));
  return scene;
}

/** A sensor `gain` times as sensitive, which clips. */
void Expose(Photo& photo, double gain)
{
  for (std::uint8_t& value : photo.Color.Values)
  {
    value = static_cast<std::uint8_t>(std::lround(std::min(255.0, gain * value)));
  }
}

double GeometricMean(const std::vector<double>& values)
{
  double sum = 0;
  for (const double value : values)
  {
    sum += std::log(value);
  }
  return std::exp(sum / static_cast<double>(values.size()));
}

/**
 * Five cameras side by side, one to four pixels of parallax apart, before a wall whose depth maps
 * are off by normal noise: every pixel meets a pixel of the other map, and depths are along one
 * axis, so the difference is that of two independent normals.
 */
Scene NoisyWall(double sigmaPx, unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, sigmaPx * Footprint);
  std::vector<Photo> photos;
  for (int i = 0; i < 5; ++i)
  {
    const double x = i * Footprint;
    const Camera camera =
      LookAt(Vector3d(x, 0, 4), Vector3d(x, 0, 0), Vector3d::UnitY(), SmallPictureK(), 160, 120);
    photos.push_back(Take(Rectangle(2, 2), Plain(100, 100, 100), camera, "p", 1));
    for (float& depth : photos.back().TrueDepth.Values)
    {
      depth += static_cast<float>(normal(random));
    }
  }
  return Scene(std::move(photos));
}
}

TEST(DepthNoise, TrueMapsHaveNextToNone)
{
  const double noise = DepthNoise(WavyBall().Views(), Footprint);
  EXPECT_GT(noise, 0) << "they were compared";
  // Interpolated across a pixel, a ball of 50 pixels leaves its chord by 1/400 of a pixel seen square
  // on, and ten times that where it is seen at a slant.
  EXPECT_LT(noise, 0.03);
}

TEST(DepthNoise, IsTheMedianDifferenceOfTwoNoisyMaps)
{
  for (const double sigma : { 0.3, 1.0, 2.0 })
  {
    // |N(0, sqrt(2) sigma)| has its median at 0.6745 sqrt(2) sigma. Each view contributes some
    // 1700 independent pixels; the median of 8500 is right to 1.3 %, so 5 % are four deviations.
    const double expected = 0.6745 * std::sqrt(2.0) * sigma;
    EXPECT_NEAR(DepthNoise(NoisyWall(sigma, 7).Views(), Footprint), expected, 0.05 * expected);
  }
}

TEST(DepthNoise, WhatIsHiddenIsNotNoise)
{
  // Opposite photographs share no surface point, though every point of one projects into the other.
  const Scene scene(TakeAll(Sphere(Vector3d::Zero(), 0.5), Waves(0.4), { OnRing(0), OnRing(180) }));
  EXPECT_EQ(DepthNoise(scene.Views(), Footprint), 0);
}

TEST(DepthNoise, NoCommonPointsGiveZero)
{
  EXPECT_EQ(DepthNoise({ WavyBall().Views()[0] }, Footprint), 0);
  EXPECT_EQ(DepthNoise({}, Footprint), 0);
  Scene unsure = WavyBall();
  unsure.Confidence = Image<float>(160, 120, 1, 0.f);
  EXPECT_EQ(DepthNoise(unsure.Views(), Footprint), 0);
}

TEST(ExposureGains, KnownGainsComeBackRelativeToTheirMean)
{
  const std::vector<double> gains{ 1.1, 0.95, 1.02, 0.9, 1.07, 0.92, 1, 1.09, 0.97, 1.04, 0.91,
    0.99 };
  Scene scene = WavyBall();
  for (std::size_t i = 0; i < gains.size(); ++i)
  {
    Expose(scene.Photos[i], gains[i]);
  }
  const auto found = ExposureGains(scene.Views(), Footprint);
  ASSERT_EQ(found.size(), gains.size());
  for (std::size_t i = 0; i < gains.size(); ++i)
  {
    // Colours are rounded to 1 of about 128, and a median averages that away.
    EXPECT_NEAR(found[i] / (gains[i] / GeometricMean(gains)), 1, 0.01) << "photograph " << i;
  }
  EXPECT_NEAR(GeometricMean(found), 1, 1e-12);
}

TEST(GainsPredictBetter, WhenExposuresDiffer)
{
  Scene scene = WavyBall();
  const std::vector<double> gains{ 1.1, 0.95, 1.02, 0.9, 1.07, 0.92, 1, 1.09, 0.97, 1.04, 0.91,
    0.99 };
  for (std::size_t i = 0; i < gains.size(); ++i)
  {
    Expose(scene.Photos[i], gains[i]);
  }
  EXPECT_TRUE(
    GainsPredictBetter(scene.Views(), ExposureGains(scene.Views(), Footprint), Footprint));
}

TEST(GainsPredictBetter, NotWhenBrightnessGoesWithTheDirection)
{
  // From one side, brighter from view to view: as under a lamp that does not turn with the object.
  Scene scene(TakeAll(Sphere(Vector3d::Zero(), 0.5), Waves(0.4), Ring(12, 10)));
  for (std::size_t i = 0; i < scene.Photos.size(); ++i)
  {
    Expose(scene.Photos[i], 0.85 + 0.025 * static_cast<double>(i));
  }
  const auto gains = ExposureGains(scene.Views(), Footprint);
  EXPECT_NEAR(gains.back() / gains.front(), 1.125 / 0.85, 0.02);
  EXPECT_FALSE(GainsPredictBetter(scene.Views(), gains, Footprint));
}

TEST(GainsPredictBetter, NotWhenThereIsNothingToPredict)
{
  EXPECT_FALSE(GainsPredictBetter({}, {}, Footprint));
  const Scene exact = WavyBall();
  EXPECT_FALSE(
    GainsPredictBetter(exact.Views(), ExposureGains(exact.Views(), Footprint), Footprint));
}

TEST(ExposureGains, ASlowDriftOverManyPhotographsComesBack)
{
  // Pairs of neighbours differ by half a percent at most; only together they tell of ten percent.
  constexpr int count = 120;
  std::vector<Camera> cameras;
  Eigen::Matrix3d k = SmallPictureK(200);
  k(0, 2) = 39.5;
  k(1, 2) = 29.5;
  for (int i = 0; i < count; ++i)
  {
    cameras.push_back(OnRing(i * 360.0 / count, 0, 4, k, 80, 60));
  }
  Scene scene(TakeAll(Sphere(Vector3d::Zero(), 0.5), Waves(0.4), cameras));
  std::vector<double> gains;
  for (int i = 0; i < count; ++i)
  {
    gains.push_back(1 + 0.1 * std::sin(2 * EIGEN_PI * i / count));
    Expose(scene.Photos[i], gains[i]);
  }
  const auto found = ExposureGains(scene.Views(), 2 * Footprint);
  for (int i = 0; i < count; ++i)
  {
    // Sixty small medians in a row, each off by some 0.05 %.
    EXPECT_NEAR(found[i] / (gains[i] / GeometricMean(gains)), 1, 0.01) << "photograph " << i;
  }
}

TEST(ExposureGains, ClippedAndBlackPixelsDoNotCount)
{
  // More than half of the ball is bright; 1.3 times as bright the sensor shows 255 instead of 286.
  const Texture halves = [](const Vector3d& p) -> Vector3d
  { return Vector3d::Constant(p.y() > -0.1 ? 220 : 100); };
  Scene scene(
    TakeAll(Sphere(Vector3d::Zero(), 0.5), halves, { OnRing(0), OnRing(30), OnRing(-30) }));
  Expose(scene.Photos[0], 1.3);
  const double mean = std::cbrt(1.3);
  auto found = ExposureGains(scene.Views(), Footprint);
  EXPECT_NEAR(found[0], 1.3 / mean, 0.01 * found[0]); // 130 / 100, without rounding
  EXPECT_NEAR(found[1], 1 / mean, 0.01 * found[1]);

  // The same with a sensor that sees nothing in that half.
  for (std::uint8_t& value : scene.Photos[0].Color.Values)
  {
    value = value == 255 ? 3 : value;
  }
  found = ExposureGains(scene.Views(), Footprint);
  EXPECT_NEAR(found[0], 1.3 / mean, 0.01 * found[0]);
  EXPECT_NEAR(found[2], 1 / mean, 0.01 * found[2]);
}

TEST(ExposureGains, APhotographWithoutCommonPointsGetsOne)
{
  Scene scene(TakeAll(
    Sphere(Vector3d::Zero(), 0.5), Waves(0.4), { OnRing(0), OnRing(20), OnRing(40), OnRing(200) }));
  for (const std::size_t i : { 0u, 3u })
  {
    Expose(scene.Photos[i], 1.1);
  }
  const auto found = ExposureGains(scene.Views(), Footprint);
  EXPECT_NEAR(found[3], 1, 1e-9); // nothing pulls it from 0 in the logarithm
  EXPECT_NEAR(found[0], 1.1 / std::cbrt(1.1), 0.01) << "the others are balanced without it";
  for (const double gain : ExposureGains({ scene.Views()[0] }, Footprint))
  {
    EXPECT_EQ(gain, 1);
  }
  EXPECT_TRUE(ExposureGains({}, Footprint).empty());
}

TEST(MapComparison, SameBitsHoweverTheWorkIsSplit)
{
  Scene scene = WavyBall();
  Expose(scene.Photos[4], 1.08);
  const auto views = scene.Views();
  for (const int threads : { 2, 5 })
  {
    EXPECT_EQ(DepthNoise(views, Footprint, InThreads(threads)), DepthNoise(views, Footprint));
    EXPECT_EQ(ExposureGains(views, Footprint, InThreads(threads)), ExposureGains(views, Footprint));
  }
}
