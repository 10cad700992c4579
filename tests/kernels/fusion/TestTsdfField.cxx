// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion/TsdfField.h"
#include "support/Expect.h"
#include "support/Scene.h"

using namespace novelview;
using namespace support;

namespace
{
constexpr double Footprint = 0.01;

/** A camera at the origin that looks along z, with one depth and one confidence everywhere. */
struct FlatMap
{
  explicit FlatMap(float depth, float confidence, double x = 0)
    : Depth(160, 120, 1, depth)
    , Confidence(160, 120, 1, confidence)
    , Distance(160, 120, 1, 50.f)
  {
    this->Cam.K = SmallPictureK();
    this->Cam.T.x() = -x;
    this->Cam.Width = 160;
    this->Cam.Height = 120;
  }
  View AsView() const
  {
    View view;
    view.Cam = this->Cam;
    view.DepthMap = this->Depth.Ref();
    view.Confidence = this->Confidence.Ref();
    view.ContourDistance = this->Distance.Ref();
    return view;
  }
  Camera Cam;
  Image<float> Depth;
  Image<float> Confidence;
  Image<float> Distance;
};

/** Two maps, one a little behind the other, and their votes at the depth of the first. */
struct TwoMaps
{
  const FlatMap A{ 2.f, 0.5f };
  const FlatMap B{ 2.02f, 0.25f, 0.1 };
  const std::vector<View> Views{ A.AsView(), B.AsView() };
  const TsdfField Field{ Views, {}, Footprint };

  static void ExpectVotes(const TsdfField& field, double expectedF, double expectedW)
  {
    double f = 0;
    double w = 0;
    EXPECT_TRUE(field.Accumulate(Vector3d(0, 0, 2), f, w));
    EXPECT_NEAR(f, expectedF, 1e-6);
    EXPECT_NEAR(w, expectedW, 1e-6);
  }
};

TsdfField::RayResult CrossingAlongZ(const TsdfField& field, double from, double to)
{
  return field.FindFirstCrossing(Vector3d::Zero(), Vector3d::UnitZ(), from, to, Footprint);
}
}

TEST(TsdfField, VotesByHand)
{
  const FlatMap map(2.f, 0.5f);
  const std::vector<View> views{ map.AsView() };
  const TsdfField field(views, {}, Footprint); // tau = 5 footprints = 0.05
  const auto vote = [&](double z, double expectedF, double expectedW)
  {
    double f = 9;
    double w = 9;
    EXPECT_TRUE(field.Accumulate(Vector3d(0, 0, z), f, w));
    EXPECT_NEAR(f, expectedF, 1e-6) << "z = " << z;
    EXPECT_NEAR(w, expectedW, 1e-6) << "z = " << z;
  };
  vote(1.5, 0.5, 0.5);   // far in front: +1 with the confidence
  vote(1.98, 0.2, 0.5);  // 0.02 in front: 0.4
  vote(2.04, -0.4, 0.5); // 0.04 behind: -0.8
  vote(2.06, 0, 0);      // hidden: says nothing
}

TEST(TsdfField, ConfidencesAddUpOverTheViews)
{
  const TwoMaps maps;
  TwoMaps::ExpectVotes(maps.Field, 0.25 * 0.4, 0.75); // A: on the surface, B: 0.02 in front of it
}

TEST(TsdfField, OfSomeViewsOnlyTheyVote)
{
  const TwoMaps maps;
  TwoMaps::ExpectVotes(maps.Field.Of({ 1 }), 0.25 * 0.4, 0.25); // B alone: 0.02 in front of it
}

TEST(TsdfField, WithoutTextureDepthsCountLessAtGrazingIncidence)
{
  // Three footprints deeper per pixel to the right: cos = 1 / sqrt(1 + 3^2).
  const auto weight = [](float confidence, double slope, double discount)
  {
    FlatMap map(2.f, confidence);
    for (int y = 0; y < 120; ++y)
    {
      for (int x = 0; x < 160; ++x)
      {
        map.Depth(x, y) =
          static_cast<float>(2 + slope * (x - map.Cam.K(0, 2)) * map.Cam.PixelFootprint(2));
      }
    }
    map.Depth(0, 0) = 1.5f; // so that the ray's sample lies in the box around the surfaces
    const std::vector<View> views{ map.AsView() };
    FusionOptions options;
    options.GrazingDiscount = discount;
    // A ray of one sample, far in front of the surface: clearance tau (w - wm) / (w + wm).
    const auto approach =
      TsdfField(views, options, Footprint)
        .FindClosestApproach(Vector3d::Zero(), Vector3d::UnitZ(), 1.9, 1.9, 1e-9);
    const double share = approach.SignedDistance / options.TruncationPx;
    return options.SilhouettePrior * (1 + share) / (1 - share);
  };
  const double grazing = 1 - 1 / std::sqrt(10.0);
  EXPECT_NEAR(weight(0.5f, 3, 1), 0.5 * (1 - 0.125 * grazing), 1e-4);
  EXPECT_NEAR(weight(0.1f, 3, 1), 0.1 * (1 - 0.729 * grazing), 1e-4);
  EXPECT_NEAR(weight(0.1f, 3, 0), 0.1, 1e-6) << "switched off";
  EXPECT_NEAR(weight(0.1f, 0, 1), 0.1, 1e-6) << "seen face on";
  EXPECT_NEAR(weight(1.0f, 3, 1), 1, 1e-6) << "texture holds it";
}

TEST(TsdfField, OutsideASilhouetteIsFree)
{
  FlatMap map(2.f, 1.f);
  map.Distance = Image<float>(160, 120, 1, -4.f);
  const std::vector<View> views{ map.AsView() };
  const TsdfField field(views, {}, Footprint);
  double f = 0;
  double w = 0;
  EXPECT_FALSE(field.Accumulate(Vector3d(0, 0, 3), f, w));
  const auto met = CrossingAlongZ(field, 1, 3);
  EXPECT_FALSE(met.Surface);
  EXPECT_EQ(met.Min, 1);
}

TEST(TsdfField, WhereNobodySeesAnythingItIsSolid)
{
  FlatMap map(0.f, 0.f); // unknown depths
  const std::vector<View> views{ map.AsView() };
  const TsdfField field(views, {}, Footprint);
  const auto met = CrossingAlongZ(field, 1, 3);
  ASSERT_TRUE(met.Surface);
  EXPECT_DOUBLE_EQ(*met.Surface, 1) << "the ray begins in the solid";
  EXPECT_LT(met.Min, 0);
  const auto behindAllCameras =
    field.FindFirstCrossing(Vector3d::Zero(), -Vector3d::UnitZ(), 1, 2, Footprint);
  EXPECT_TRUE(behindAllCameras.Surface);
}

TEST(TsdfField, TheSurfaceLiesWhereTheVoteEqualsThePrior)
{
  const FlatMap map(2.f, 0.5f);
  const std::vector<View> views{ map.AsView() };
  FusionOptions options;
  const auto met = CrossingAlongZ(TsdfField(views, options, Footprint), 1.5, 2.5);
  ASSERT_TRUE(met.Surface);
  // 0.5 s / tau = w0: s = 0.015. Six halvings of a step of one footprint.
  EXPECT_NEAR(*met.Surface, 2 - 0.05 * options.SurfacePrior / 0.5, Footprint / 64);
  EXPECT_LT(met.Min, 0);
}

TEST(TsdfField, ARayThroughEmptySpaceMeetsNothing)
{
  const FlatMap map(2.f, 0.5f);
  const std::vector<View> views{ map.AsView() };
  const auto met = CrossingAlongZ(TsdfField(views, {}, Footprint), 1, 1.9);
  EXPECT_FALSE(met.Surface);
  EXPECT_GT(met.Min, 0);
}

TEST(TsdfField, ARayAlongAWallPassesAtItsDistance)
{
  const FlatMap map(2.f, 0.5f);
  const std::vector<View> views{ map.AsView() };
  FusionOptions options;
  options.SilhouettePrior = 0; // the prior would shift it by tau w0m / (W + w0m)
  const TsdfField field(views, options, Footprint);
  const auto clearance = [&](double offPx)
  {
    return field
      .FindClosestApproach(
        Vector3d(-0.3, 0, 2 - offPx * Footprint), Vector3d::UnitX(), 0, 0.6, Footprint)
      .SignedDistance;
  };
  for (const double offPx : { -4.5, -1.0, -0.25, 0.0, 0.25, 1.0, 4.5 })
  {
    EXPECT_NEAR(clearance(offPx), offPx, 1e-4) << "depths are floats";
  }
  EXPECT_EQ(clearance(7), options.TruncationPx);
  EXPECT_EQ(clearance(-7), -options.TruncationPx);
}

TEST(TsdfField, ThePriorDrawsTheSignedDistanceInwards)
{
  const FlatMap map(2.f, 0.5f);
  const std::vector<View> views{ map.AsView() };
  const FusionOptions options;
  // Begun outside the silhouettes' chord, so that the prior is the plain one at the first sample.
  const auto approach =
    TsdfField(views, options, Footprint)
      .FindClosestApproach(Vector3d(0, 0, 1.98), Vector3d::UnitX(), 0, 1e-9, 1e-6);
  const double wm = options.SilhouettePrior;
  EXPECT_NEAR(approach.SignedDistance, 5 * (0.5 * 0.4 - wm) / (0.5 + wm), 1e-3);
}

TEST(TsdfField, ARayParallelToAnAxisBesideAllMapsMeetsNothing)
{
  // Behind the wall, within the silhouettes: no view sees the place, but no map reaches there.
  const FlatMap map(2.f, 0.5f);
  const std::vector<View> views{ map.AsView() };
  const TsdfField field(views, {}, Footprint);
  const Vector3d origin(-0.3, 0, 2.3);
  EXPECT_FALSE(field.FindFirstCrossing(origin, Vector3d::UnitX(), 0, 0.6, Footprint).Surface);
  EXPECT_EQ(field.FindFirstCrossing(origin, Vector3d::UnitX(), 0, 0.6, Footprint).Min, 1);
  EXPECT_EQ(
    field.FindClosestApproach(origin, Vector3d::UnitX(), 0, 0.6, Footprint).SignedDistance, 5);
  EXPECT_TRUE(std::isinf(field.PriorNeeded(origin, Vector3d::UnitX(), 0, 0.6, Footprint, 0)));
}

namespace
{
/** A ball with true depth maps all around. */
struct BallCase
{
  static constexpr double Radius = 0.5;
  std::vector<Photo> Photos =
    TakeAll(Sphere(Vector3d::Zero(), Radius), Plain(200, 200, 200), Ring(12, 30));
  Image<float> Trusted{ 160, 120, 1, 1.f };
  Image<float> Doubted{ 160, 120, 1, 0.f };

  std::vector<View> Views(bool trusted = true) const
  {
    std::vector<View> views = ViewsOf(this->Photos);
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      views[i].DepthMap = this->Photos[i].TrueDepth.Ref();
      views[i].Confidence = trusted ? this->Trusted.Ref() : this->Doubted.Ref();
    }
    return views;
  }
};

const BallCase& TheBall()
{
  static const BallCase ball;
  return ball;
}

const FusionOptions Short{ 2, 0.05, 0.12 }; ///< as the outline is looked for

/** A ray from a camera on the ring that passes the ball at an angle about the line of sight. */
struct PassingRay
{
  PassingRay(double cameraDeg, double offPx, double aboutDeg)
    : Origin(OnRing(cameraDeg).Centre())
  {
    const Camera camera = OnRing(cameraDeg);
    const double sine = (BallCase::Radius + offPx * Footprint) / this->Origin.norm();
    const double about = aboutDeg * EIGEN_PI / 180;
    const Vector3d sideways =
      std::cos(about) * camera.R.row(0).transpose() + std::sin(about) * camera.R.row(1).transpose();
    this->Direction = sine * sideways - std::sqrt(1 - sine * sine) * this->Origin.normalized();
  }
  TsdfField::ClosestApproach FindClosestApproach(const TsdfField& field) const
  {
    return field.FindClosestApproach(this->Origin, this->Direction, 3.3, 4.7, 2 * Footprint);
  }
  Vector3d Origin;
  Vector3d Direction;
};

void ExpectNothingMet(
  const TsdfField& field, const Vector3d& origin, const Vector3d& direction, double to)
{
  const auto met = field.FindFirstCrossing(origin, direction, 0.1, to, 2 * Footprint);
  EXPECT_FALSE(met.Surface);
  EXPECT_EQ(met.Min, 1);
  EXPECT_EQ(field.FindClosestApproach(origin, direction, 0.1, to, 2 * Footprint).SignedDistance,
    Short.TruncationPx);
  EXPECT_TRUE(std::isinf(field.PriorNeeded(origin, direction, 0.1, to, 2 * Footprint, 0)));
}
}

TEST(TsdfField, RaysPassABallOnTheRightSide)
{
  const auto views = TheBall().Views();
  const TsdfField field(views, Short, Footprint);
  for (double aboutDeg = 0; aboutDeg < 360; aboutDeg += 30)
  {
    for (const double offPx : { 0.5, 1.0, 3.0 })
    {
      EXPECT_GT(PassingRay(15, offPx, aboutDeg).FindClosestApproach(field).SignedDistance, 0.2)
        << offPx << " at " << aboutDeg;
      EXPECT_LT(PassingRay(15, -offPx, aboutDeg).FindClosestApproach(field).SignedDistance, -0.2)
        << -offPx << " at " << aboutDeg;
    }
    EXPECT_EQ(
      PassingRay(15, 6, aboutDeg).FindClosestApproach(field).SignedDistance, Short.TruncationPx);
    EXPECT_EQ(
      PassingRay(15, -12, aboutDeg).FindClosestApproach(field).SignedDistance, -Short.TruncationPx);
  }
}

TEST(TsdfField, TheSignedDistanceOfABallIsZeroAtItsSilhouette)
{
  const auto views = TheBall().Views();
  const TsdfField field(views, Short, Footprint);
  double sum = 0;
  for (double aboutDeg = 0; aboutDeg < 360; aboutDeg += 10)
  {
    double low = -2;
    double high = 2;
    for (int halving = 0; halving < 8; ++halving)
    {
      const double middle = 0.5 * (low + high);
      (PassingRay(15, middle, aboutDeg).FindClosestApproach(field).SignedDistance > 0 ? high
                                                                                      : low) =
        middle;
    }
    sum += low;
    EXPECT_LT(std::abs(low), 0.4) << aboutDeg;
  }
  EXPECT_LT(std::abs(sum / 36), 0.15);
}

TEST(TsdfField, WithoutVotesTheSilhouettesBoundTheRay)
{
  const auto views = TheBall().Views(false);
  const TsdfField field(views, Short, Footprint);
  // Seen from a photograph's own place, its contour is the nearest of all where the ray touches the
  // ball: the others' planes are turned by 30 degrees and more.
  const Photo& own = TheBall().Photos[1];
  for (const double offPx : { -1.5, -0.5, 0.0, 0.5, 1.5 })
  {
    const PassingRay ray(30, offPx, 0);
    const Vector2d pixel = own.Cam.Project(ray.Origin + 4 * ray.Direction);
    const double contour = SampleBilinear(own.ContourDistance.Ref(), pixel.x(), pixel.y());
    EXPECT_NEAR(ray.FindClosestApproach(field).SignedDistance, -contour, 0.01)
      << offPx; // rounding of one projection
  }
  EXPECT_EQ(PassingRay(30, -5, 0).FindClosestApproach(field).SignedDistance, -Short.TruncationPx);
  EXPECT_EQ(PassingRay(30, 5, 0).FindClosestApproach(field).SignedDistance, Short.TruncationPx);
  // Half-way between two photographs the hull's corner stands out by R (1 / cos 15 - 1) = 1.76.
  // (The photographs opposite, which see the same contour, left out.)
  const std::vector<View> front{ views[10], views[11], views[0], views[1], views[2], views[3] };
  const TsdfField hull(front, Short, Footprint);
  EXPECT_LT(PassingRay(15, 1.2, 0).FindClosestApproach(hull).SignedDistance, -0.2);
  EXPECT_GT(PassingRay(15, 2.3, 0).FindClosestApproach(hull).SignedDistance, 0.2);
}

TEST(TsdfField, FarBehindTheObjectWhereNoCameraSeesThereIsNothing)
{
  const auto views = TheBall().Views();
  const TsdfField field(views, Short, Footprint);
  // Past the ball and up, out of every frame.
  const Vector3d origin(0, -0.9, 4);
  const Vector3d direction = Vector3d(0, 1.62, -4).normalized();
  const Vector3d far = origin + 8 * direction;
  for (const View& view : views)
  {
    ASSERT_FALSE(view.Cam.Depth(far) > 0 && view.Cam.InFrame(view.Cam.Project(far)));
  }
  ExpectNothingMet(field, origin, direction, 12);
}

TEST(TsdfField, ARayThroughTheObjectMeetsItHoweverFarItGoes)
{
  const auto views = TheBall().Views();
  const TsdfField field(views, Short, Footprint);
  const PassingRay ray(15, -20, 0);
  const auto met = field.FindFirstCrossing(ray.Origin, ray.Direction, 0.1, 12, 2 * Footprint);
  ASSERT_TRUE(met.Surface);
  EXPECT_LT(met.Min, 0);
  // Half a pixel of a depth map is a third of a footprint of depth there; the prior takes less.
  EXPECT_NEAR((ray.Origin + *met.Surface * ray.Direction).norm(), 0.5, 0.5 * Footprint);
  EXPECT_EQ(field.PriorNeeded(ray.Origin, ray.Direction, 0.1, 12, 2 * Footprint, 0), 0);
}

TEST(TsdfField, SampleRowGivesTheSignedDistanceWithVotesThatFadeBehindTheSurface)
{
  // One sure map of a plane at depth 4; tau = 4 footprints; prior as good as none.
  const FlatMap map(4, 1);
  const std::vector<View> views{ map.AsView() };
  const TsdfField field(views, { 4, 1e-6, 0.12 }, Footprint);
  TsdfField::LatticeSample samples[5];
  // From 2 footprints in front of the plane to 6 behind it.
  field.SampleRow(Vector3d(0, 0, 4 - 2 * Footprint), 2 * Footprint * Vector3d::UnitZ(), 5, samples);
  const double distances[] = { 2, 0, -2, -4, -4 };
  const double weights[] = { 1, 1, 0.5, 0, 0 };
  for (int n = 0; n < 5; ++n)
  {
    EXPECT_NEAR(samples[n].Distance, distances[n], 1e-3) << n;
    EXPECT_NEAR(samples[n].Weight, weights[n], 1e-3) << n;
    EXPECT_EQ(samples[n].Outside, -4) << "50 pixels inside the silhouette";
  }
}
