// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/ViewSelection.h"
#include "stereo/CostVolume.h"
#include "stereo/DepthConfidence.h"
#include "stereo/MaskedMedian.h"
#include "stereo/NeighbourMatching.h"
#include "stereo/ReferenceDepth.h"
#include "stereo/SemiGlobal.h"
#include "support/Expect.h"
#include "support/Scene.h"

using namespace novelview;
using namespace support;

namespace
{
std::int16_t InUnits(float cost)
{
  return static_cast<std::int16_t>(std::lround(cost * CostVolume::Unit));
}

/** The cost of a label at a pixel of the box. */
float CostAt(const CostVolume& volume, int x, int y, int label)
{
  return static_cast<float>(volume.Row(y, label)[x]) / CostVolume::Unit;
}

/** A volume of one row with the given costs: costs[x][label]. */
CostVolume OneRow(const std::vector<std::vector<float>>& costs)
{
  CostVolume volume;
  volume.Box = { 0, static_cast<int>(costs.size()), 0, 1 };
  volume.Labels = { 0, 1, static_cast<int>(costs.front().size()) };
  volume.Costs.resize(costs.size() * costs.front().size());
  for (std::size_t x = 0; x < costs.size(); ++x)
  {
    for (std::size_t label = 0; label < costs[x].size(); ++label)
    {
      volume.Row(0, static_cast<int>(label))[x] = InUnits(costs[x][label]);
    }
  }
  return volume;
}
}

TEST(CostVolume, ReducedImagesKeepTheGeometry)
{
  const Photo photo = Take(Sphere(Vector3d::Zero(), 0.5), Waves(0.4), OnRing(20), "p");
  const MatchImage half = MakeMatchImage(photo.AsView(), 2);
  EXPECT_EQ(half.Cam.Width, 80);
  EXPECT_EQ(half.Cam.Height, 60);
  const Vector3d point(0.1, -0.2, 0.3);
  const Vector2d full = photo.Cam.Project(point);
  // The small pixel 0 has its centre between the large pixels 0 and 1.
  EXPECT_LT((half.Cam.Project(point) - (full - Vector2d(0.5, 0.5)) / 2).norm(), 1e-9);
}

TEST(CostVolume, ReducedPixelsAreMeansOverTheObject)
{
  Photo photo = Take(Rectangle(9, 9), Plain(0, 0, 0), OnRing(0), "p", 1);
  const double greys[4] = { 10, 20, 41, 200 };
  for (int n = 0; n < 4; ++n)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      photo.Color(n % 2, n / 2, channel) = static_cast<std::uint8_t>(greys[n]);
      photo.Color(2 + n % 2, n / 2, channel) = static_cast<std::uint8_t>(greys[n]);
    }
  }
  photo.Mask(1, 1) = 0;                                       // three of four are object
  photo.Mask(2, 0) = photo.Mask(3, 0) = photo.Mask(2, 1) = 0; // one of four
  const MatchImage half = MakeMatchImage(photo.AsView(), 2);
  EXPECT_EQ(half.Pixels(0, 0, 0), 24); // (10 + 20 + 41) / 3 = 23.67
  EXPECT_EQ(half.Pixels(0, 0, 3), 24);
  EXPECT_EQ(half.Pixels(1, 0, 3), 0) << "background";
  EXPECT_EQ(half.Pixels(5, 5, 3), 1) << "black object is not background";
}

TEST(CostVolume, TheLeastCostIsAtTheTrueDepthOfAPlane)
{
  const Shape plane = Rectangle(0.7, 0.5);
  const auto photos = TakeAll(plane, Waves(0.16), { OnRing(0), OnRing(25), OnRing(-25) });
  std::vector<MatchImage> images;
  for (const Photo& photo : photos)
  {
    images.push_back(MakeMatchImage(photo.AsView(), 1));
  }
  // The base lies five labels in front of the plane.
  Image<float> base = photos[0].TrueDepth;
  for (float& depth : base.Values)
  {
    depth = depth > 0 ? depth - 0.1f : 0.f;
  }
  const Image<float> last(160, 120, 1, 1.f);
  const PixelBox box = BoxOfBase(base);
  const DepthHypotheses labels{ 0, 0.02, 11 };
  const CostVolume volume =
    MatchNeighbours(images[0], base, last, { &images[1], &images[2] }, box, labels, {});
  int right = 0;
  int total = 0;
  for (int y = 4; y < box.Height() - 4; ++y)
  {
    for (int x = 4; x < box.Width() - 4; ++x)
    {
      int best = 0;
      for (int label = 0; label < labels.Count; ++label)
      {
        const float cost = CostAt(volume, x, y, label);
        EXPECT_GE(cost, 0);
        EXPECT_LE(cost, 1);
        best = cost < CostAt(volume, x, y, best) ? label : best;
      }
      ++total;
      right += best == 5;
    }
  }
  // Waves of sixteen pixels leave few windows without an answer.
  EXPECT_GT(right, 0.95 * total);
}

TEST(CostVolume, NothingIsMatchedBeyondTheLastOffset)
{
  const auto photos = TakeAll(Rectangle(0.7, 0.5), Waves(0.16), { OnRing(0), OnRing(25) });
  const MatchImage key = MakeMatchImage(photos[0].AsView(), 1);
  const MatchImage other = MakeMatchImage(photos[1].AsView(), 1);
  const Image<float> last(160, 120, 1, 0.05f);
  const DepthHypotheses labels{ 0, 0.1, 2 };
  const PixelBox box{ 70, 91, 50, 71 };
  const auto volume = MatchNeighbours(key, photos[0].TrueDepth, last, { &other }, box, labels, {});
  EXPECT_LT(CostAt(volume, 10, 10, 0), 0.2f);
  EXPECT_EQ(CostAt(volume, 10, 10, 1), 1.f);
  const auto alone = MatchNeighbours(key, photos[0].TrueDepth, last, {}, box, labels, {});
  EXPECT_THAT(alone.Costs, testing::Each(CostVolume::Unit));
}

TEST(SemiGlobal, WithoutPenaltiesEveryDirectionAddsTheCostsThemselves)
{
  const auto volume = OneRow({ { 0.3f, 0.5f, 0.1f }, { 0.2f, 0.9f, 0.4f } });
  const Image<float> base(2, 1, 1, 1.f);
  const auto sums = AggregateSemiGlobally(volume, base, { 0, 0 });
  for (std::size_t i = 0; i < volume.Costs.size(); ++i)
  {
    EXPECT_EQ(sums.Costs[i], 8 * volume.Costs[i]);
  }
}

TEST(SemiGlobal, NeighboursDecideWhereAPixelDoesNotKnow)
{
  // The middle pixel likes label 2 a little better; its neighbours are sure of label 0.
  const auto volume = OneRow({ { 0, 1, 1 }, { 0.3f, 0.3f, 0.25f }, { 0, 1, 1 } });
  const Image<float> base(3, 1, 1, 1.f);
  Image<std::uint8_t> winner;
  WinnerTakesAll(AggregateSemiGlobally(volume, base, { 0.03, 0.2 }), base, winner);
  EXPECT_EQ(winner(1, 0), 0);
  WinnerTakesAll(AggregateSemiGlobally(volume, base, { 0, 0 }), base, winner);
  EXPECT_EQ(winner(1, 0), 2);
}

TEST(SemiGlobal, PathsDoNotCrossPixelsWithoutABase)
{
  const auto volume = OneRow({ { 0, 1, 1 }, { 0.3f, 0.3f, 0.25f }, { 0, 1, 1 } });
  Image<float> base(3, 1, 1, 1.f);
  base(0, 0) = base(2, 0) = 0;
  Image<std::uint8_t> winner;
  const auto depth =
    WinnerTakesAll(AggregateSemiGlobally(volume, base, { 0.03, 0.2 }), base, winner);
  EXPECT_EQ(winner(1, 0), 2);
  EXPECT_EQ(depth(0, 0), 0);
}

TEST(SemiGlobal, TheDepthIsRefinedByAParabola)
{
  auto volume = OneRow({ { 3, 1, 2 } });
  volume.Labels.First = 0.5;
  volume.Labels.Step = 0.1;
  const Image<float> base(1, 1, 1, 2.f);
  Image<std::uint8_t> winner;
  const auto depth = WinnerTakesAll(volume, base, winner);
  EXPECT_EQ(winner(0, 0), 1);
  // The vertex of the parabola through (0,3), (1,1), (2,2) is at 1 + 1/6.
  EXPECT_NEAR(depth(0, 0), 2 + 0.5 + 0.1 * (1 + 1. / 6), 1e-6);
}

TEST(ReferenceDepth, MedianSkipsTheUnknown)
{
  Image<float> image(3, 3);
  image(0, 0) = 5;
  image(1, 0) = 1;
  image(2, 2) = 3;
  const auto median = MaskedMedian(image, 1);
  EXPECT_EQ(median(1, 1), 0) << "the unknown stays unknown";
  EXPECT_EQ(median(0, 0), 5) << "of 1 and 5 the upper";
  EXPECT_EQ(MaskedMedian(image, 2)(1, 0), 3);
}

TEST(ReferenceDepth, ConfidenceFallsWithAgreement)
{
  const auto photos =
    TakeAll(Rectangle(0.7, 0.5), Waves(0.16), { OnRing(0), OnRing(20), OnRing(-20) });
  const auto views = ViewsOf(photos);
  const double footprint = MedianFootprint(views, Vector3d::Zero());
  std::vector<Image<float>> depths;
  for (const Photo& photo : photos)
  {
    depths.push_back(photo.TrueDepth);
  }
  const Image<float> score(160, 120, 1, 0.5f);
  // Seen square on, two maps agree: score x 1 x 1; the slanted difference of floats costs a little.
  EXPECT_NEAR(DepthConfidence(views, 0, depths, score, {}, footprint)(80, 60), 0.5, 1e-3);
  for (float& depth : depths[1].Values)
  {
    depth *= depth > 0 ? 0.9f : 1.f; // forty footprints nearer: neither agrees nor sees through
  }
  EXPECT_NEAR(DepthConfidence(views, 0, depths, score, {}, footprint)(80, 60), 0.3, 1e-3);
  for (float& depth : depths[2].Values)
  {
    depth *= depth > 0 ? 1.1f : 1.f; // looks through the surface
  }
  EXPECT_NEAR(
    DepthConfidence(views, 0, depths, score, {}, footprint)(80, 60), 0.5 * 0.12 * 0.3, 1e-3);
}

namespace
{
/** A textured sphere in a hull six pixels too large. */
struct SphereCase
{
  std::vector<Photo> Photos = TakeAll(Sphere(Vector3d::Zero(), 0.5), Waves(0.16), Ring(12, 30));
  std::vector<View> Views = ViewsOf(Photos);
  TriangleMesh Hull = SphereMesh(Vector3d::Zero(), 0.56, 4);
};
const SphereCase& TheCase()
{
  static const SphereCase sphere;
  return sphere;
}
}

TEST(ReferenceDepth, OfATexturedSphereIsRightToAFootprint)
{
  const SphereCase& sphere = TheCase();
  const auto depths = EstimateReferenceDepths(sphere.Views, sphere.Hull);
  ASSERT_EQ(depths.size(), sphere.Views.size());
  const double footprint = MedianFootprint(sphere.Views, Vector3d::Zero());
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    std::vector<double> errors;
    for (int y = 0; y < 120; ++y)
    {
      for (int x = 0; x < 160; ++x)
      {
        const bool object = sphere.Photos[i].Mask(x, y) > 127;
        EXPECT_EQ(depths[i].Depth(x, y) > 0, object);
        EXPECT_GE(depths[i].Confidence(x, y), 0);
        EXPECT_LE(depths[i].Confidence(x, y), 1);
        if (sphere.Photos[i].TrueDepth(x, y) > 0 && depths[i].Depth(x, y) > 0)
        {
          errors.push_back(
            std::abs(depths[i].Depth(x, y) - sphere.Photos[i].TrueDepth(x, y)) / footprint);
        }
      }
    }
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    EXPECT_LT(*middle, 1); // the aim of the stage
  }
}

TEST(ReferenceDepth, ClippedWindowsAreNoEvidence)
{
  const SphereCase& sphere = TheCase();
  std::vector<Photo> photos(sphere.Photos.begin(), sphere.Photos.begin() + 4);
  for (Photo& photo : photos)
  {
    for (int y = 40; y < 60; ++y)
    {
      std::fill_n(&photo.Color(60, y, 0), 3 * 30, std::uint8_t(255));
    }
  }
  const auto depths = EstimateReferenceDepths(ViewsOf(photos), sphere.Hull);
  for (const ReferenceDepth& map : depths)
  {
    EXPECT_EQ(map.Confidence(75, 50), 0);
    EXPECT_GT(map.Confidence(75, 75), 0);
  }
}

TEST(ReferenceDepth, SameBitsWithOneAndMoreThreads)
{
  const SphereCase& sphere = TheCase();
  const std::vector<View> four(sphere.Views.begin(), sphere.Views.begin() + 4);
  const auto one = EstimateReferenceDepths(four, sphere.Hull);
  const auto three = EstimateReferenceDepths(four, sphere.Hull, {}, InThreads(3));
  for (std::size_t i = 0; i < four.size(); ++i)
  {
    EXPECT_EQ(one[i].Depth.Values, three[i].Depth.Values);
    EXPECT_EQ(one[i].Confidence.Values, three[i].Confidence.Values);
  }
}

TEST(ReferenceDepth, OfManyPhotographsOnlyThoseAroundAreFused)
{
  const SphereCase& sphere = TheCase();
  const std::vector<View> six(sphere.Views.begin(), sphere.Views.begin() + 6);
  const auto depthsWith = [&](int fused)
  {
    ReferenceDepthOptions options;
    options.FusedViews = fused;
    return EstimateReferenceDepths(six, sphere.Hull, options);
  };
  const auto all = depthsWith(6);
  const auto more = depthsWith(16);
  const auto some = depthsWith(3);
  std::vector<double> apart; // footprints, between the maps with three and with all
  const double footprint = MedianFootprint(sphere.Views, Vector3d::Zero());
  for (std::size_t i = 0; i < six.size(); ++i)
  {
    EXPECT_EQ(all[i].Depth.Values, more[i].Depth.Values) << "there are but six";
    for (std::size_t n = 0; n < all[i].Depth.Values.size(); ++n)
    {
      if (all[i].Depth.Values[n] > 0)
      {
        apart.push_back(std::abs(all[i].Depth.Values[n] - some[i].Depth.Values[n]) / footprint);
      }
    }
  }
  const auto tenth = apart.begin() + static_cast<std::ptrdiff_t>(0.9 * apart.size());
  std::nth_element(apart.begin(), tenth, apart.end());
  EXPECT_GT(*std::max_element(apart.begin(), apart.end()), 0) << "the number matters";
  EXPECT_LT(*tenth, 1) << "and little: the second pass looks for the surface itself";
}

TEST(ReferenceDepth, ViewsWithoutNeighboursAreNotTrusted)
{
  const SphereCase& sphere = TheCase();
  const std::vector<View> opposite{ sphere.Views[0], sphere.Views[6] };
  for (const ReferenceDepth& depth : EstimateReferenceDepths(opposite, sphere.Hull))
  {
    EXPECT_THAT(depth.Confidence.Values, testing::Each(0.f));
    EXPECT_EQ(depth.Depth.Width, 160);
  }
}

TEST(ReferenceDepth, AnEmptyHullGivesUnknownDepthsOfFullSize)
{
  const auto depths = EstimateReferenceDepths(TheCase().Views, {});
  for (const ReferenceDepth& depth : depths)
  {
    EXPECT_EQ(depth.Depth.Values, std::vector<float>(160 * 120, 0.f));
    EXPECT_EQ(depth.Confidence.Values, std::vector<float>(160 * 120, 0.f));
  }
}
