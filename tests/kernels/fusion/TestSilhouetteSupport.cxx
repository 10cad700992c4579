// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion/FusedSilhouette.h"
#include "fusion/SilhouettePrior.h"
#include "fusion/SilhouetteSupport.h"
#include "geometry/ViewSelection.h"
#include "support/DentCase.h"
#include "support/Expect.h"

using namespace novelview;
using namespace support;

namespace
{
const FusionOptions Outline{ 2, 0.05, 0.12 };

/**
 * The dented sphere, but all photographs that see its point in the direction of camera 3 claim, with
 * a confidence, that the surface there lies far behind. It is on the contours of cameras 0 and 6.
 */
struct HollowCase
{
  /** `scatter`: how far the claimed depths differ from pixel to pixel. */
  explicit HollowCase(float confidence, float scatter = 0)
    : Views(TheDent().Views)
    , Depths(this->Views.size())
    , Confidences(this->Views.size(), TheDent().Confidence)
  {
    const Vector3d middle = TheDent().Photos[3].Cam.Centre().normalized();
    for (std::size_t i = 0; i < this->Views.size(); ++i)
    {
      const Photo& photo = TheDent().Photos[i];
      this->Depths[i] = photo.TrueDepth;
      for (int y = 0; y < 120; ++y)
      {
        for (int x = 0; x < 160; ++x)
        {
          float& depth = this->Depths[i](x, y);
          if (depth > 0 &&
            photo.Cam.Unproject(Vector2d(x, y), depth).normalized().dot(middle) > 0.9)
          {
            depth += 0.4f - scatter * static_cast<float>((7 * x + 3 * y + 5 * i) % 11) / 10;
            this->Confidences[i](x, y) = confidence;
          }
        }
      }
      this->Views[i].DepthMap = std::as_const(this->Depths[i]).Ref();
      this->Views[i].Confidence = std::as_const(this->Confidences[i]).Ref();
    }
  }

  std::vector<SupportPoint> Support(
    const Execution& execution = {}, const SilhouetteSupportOptions& options = {}) const
  {
    const double footprint = MedianFootprint(this->Views, Vector3d::Zero());
    return FindSilhouetteSupport(this->Views, TsdfField(this->Views, Outline, footprint),
      TheDent().Mesh, footprint, options, execution);
  }

  /** The pixels that camera 0 shows of the object. */
  long Area(const std::vector<SupportPoint>& support) const
  {
    FusedSilhouetteOptions options;
    options.Support = support;
    const double footprint = MedianFootprint(this->Views, Vector3d::Zero());
    const Image<float> found = FusedSilhouette(TheDent().Mesh, this->Views,
      TsdfField(this->Views, Outline, footprint), TheDent().Photos[0].Cam, footprint, options);
    return std::count_if(
      found.Values.begin(), found.Values.end(), [](float distance) { return distance > 0; });
  }

  std::vector<View> Views;
  std::vector<Image<float>> Depths;
  std::vector<Image<float>> Confidences;
};

long TrueArea()
{
  const Image<std::uint8_t>& mask = TheDent().Photos[0].Mask;
  return std::count_if(
    mask.Values.begin(), mask.Values.end(), [](std::uint8_t value) { return value > 127; });
}
}

TEST(SilhouetteSupport, ExactMapsNeedHardlyAny)
{
  const double footprint = MedianFootprint(TheDent().Views, Vector3d::Zero());
  const auto points = FindSilhouetteSupport(
    TheDent().Views, TsdfField(TheDent().Views, Outline, footprint), TheDent().Mesh, footprint);
  EXPECT_LT(points.size(), 50u);
}

TEST(SilhouetteSupport, UnsureMapsDoNotBiteIntoTheContour)
{
  const HollowCase hollow(0.15f);
  const auto points = hollow.Support();
  ASSERT_GT(points.size(), 50u);
  for (const SupportPoint& point : points)
  {
    EXPECT_LT(point.Position.norm(), 0.53) << "outside the mesh";
    EXPECT_GE(point.InsidePx, 1);
  }
  const long carved = hollow.Area({});
  EXPECT_LT(carved, 0.99 * TrueArea());
  EXPECT_GT(hollow.Area(points), TrueArea() - 0.6 * (TrueArea() - carved));
}

TEST(SilhouetteSupport, WhereManyMapsAreSureTheyAreBelieved)
{
  const HollowCase hollow(1);
  EXPECT_LT(hollow.Support().size(), 50u);
}

TEST(SilhouetteSupport, ScatteredPointsMakeNoSpikes)
{
  SilhouetteSupportOptions all;
  all.MinAgreeing = 0;
  all.AgreementPx = 1000;
  const auto share = [&](const HollowCase& hollow)
  {
    return static_cast<double>(hollow.Support().size()) /
      static_cast<double>(hollow.Support({}, all).size());
  };
  EXPECT_GT(share(HollowCase(0.15f)), 0.7);
  EXPECT_LT(share(HollowCase(0.15f, 0.39f)), 0.5);
}

TEST(SilhouetteSupport, DoesNotDependOnThreads)
{
  const HollowCase hollow(0.15f);
  const auto one = hollow.Support();
  const auto three = hollow.Support(InThreads(3));
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    EXPECT_EQ(one[i].Position, three[i].Position);
    EXPECT_EQ(one[i].InsidePx, three[i].InsidePx);
  }
}

TEST(SilhouettePrior, ExactMapsNeedTheLeast)
{
  SilhouettePriorOptions options;
  options.Noise = 1.5; // twice that is the truncation
  EXPECT_EQ(FindSilhouettePrior(TheDent().Views, TheDent().Mesh, options), options.Min);
  options.Noise = 3;
  EXPECT_NEAR(
    FindSilhouettePrior(TheDent().Views, TheDent().Mesh, options), 4 * options.Min, 1e-12);
}

TEST(SilhouettePrior, NoisyMapsThatContradictTheSilhouettesAreOutvoted)
{
  // As photographs of plaster: the maps are noise, and carve struts and necks away.
  const HollowCase hollow(0.5f);
  SilhouettePriorOptions options;
  options.Max = 100;
  options.Fusion.TruncationPx = 4;
  options.AcceptedLoss = 1e-3; // the hollow is small
  const double needed = FindSilhouettePrior(hollow.Views, TheDent().Mesh, options);
  ASSERT_GT(needed, 2 * options.Min);
  options.Noise = 0.3;
  EXPECT_EQ(FindSilhouettePrior(hollow.Views, TheDent().Mesh, options), needed);
  options.Noise = 2;
  EXPECT_NEAR(FindSilhouettePrior(hollow.Views, TheDent().Mesh, options),
    options.Min + 4 * (needed - options.Min), 1e-12);
  options.Max = 1.5 * needed;
  EXPECT_EQ(FindSilhouettePrior(hollow.Views, TheDent().Mesh, options), options.Max);
}
