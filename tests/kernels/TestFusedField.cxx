// SPDX-License-Identifier: GPL-3.0-or-later
#include "FusedField.h"
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

FusedField::RayResult WalkAlongZ(const FusedField& field, double from, double to)
{
  return field.Walk(Vector3d::Zero(), Vector3d::UnitZ(), from, to, Footprint);
}
}

TEST(FusedField, VotesByHand)
{
  const FlatMap map(2.f, 0.5f);
  const std::vector<View> views{ map.AsView() };
  const FusedField field(views, {}, Footprint); // tau = 5 footprints = 0.05
  const auto vote = [&](double z, double expectedF, double expectedW)
  {
    double f = 9;
    double w = 9;
    EXPECT_TRUE(field.Vote(Vector3d(0, 0, z), f, w));
    EXPECT_NEAR(f, expectedF, 1e-6) << "z = " << z;
    EXPECT_NEAR(w, expectedW, 1e-6) << "z = " << z;
  };
  vote(1.5, 0.5, 0.5);   // far in front: +1 with the confidence
  vote(1.98, 0.2, 0.5);  // 0.02 in front: 0.4
  vote(2.04, -0.4, 0.5); // 0.04 behind: -0.8
  vote(2.06, 0, 0);      // hidden: says nothing
}

TEST(FusedField, ConfidencesAddUpOverTheViews)
{
  const FlatMap a(2.f, 0.5f);
  const FlatMap b(2.02f, 0.25f, 0.1);
  const std::vector<View> views{ a.AsView(), b.AsView() };
  double f = 0;
  double w = 0;
  EXPECT_TRUE(FusedField(views, {}, Footprint).Vote(Vector3d(0, 0, 2), f, w));
  EXPECT_NEAR(f, 0.25 * 0.4, 1e-6); // a: on the surface, b: 0.02 in front of it
  EXPECT_NEAR(w, 0.75, 1e-6);
}

TEST(FusedField, OutsideASilhouetteIsFree)
{
  FlatMap map(2.f, 1.f);
  map.Distance = Image<float>(160, 120, 1, -4.f);
  const std::vector<View> views{ map.AsView() };
  const FusedField field(views, {}, Footprint);
  double f = 0;
  double w = 0;
  EXPECT_FALSE(field.Vote(Vector3d(0, 0, 3), f, w));
  const auto met = WalkAlongZ(field, 1, 3);
  EXPECT_FALSE(met.Surface);
  EXPECT_EQ(met.Least, 1);
}

TEST(FusedField, WhereNobodySeesAnythingItIsSolid)
{
  FlatMap map(0.f, 0.f); // unknown depths
  const std::vector<View> views{ map.AsView() };
  const FusedField field(views, {}, Footprint);
  const auto met = WalkAlongZ(field, 1, 3);
  ASSERT_TRUE(met.Surface);
  EXPECT_DOUBLE_EQ(*met.Surface, 1) << "the ray begins in the solid";
  EXPECT_LT(met.Least, 0);
  const auto behindAllCameras = field.Walk(Vector3d::Zero(), -Vector3d::UnitZ(), 1, 2, Footprint);
  EXPECT_TRUE(behindAllCameras.Surface);
}

TEST(FusedField, TheSurfaceLiesWhereTheVoteEqualsThePrior)
{
  const FlatMap map(2.f, 0.5f);
  const std::vector<View> views{ map.AsView() };
  FusionOptions options;
  const auto met = WalkAlongZ(FusedField(views, options, Footprint), 1.5, 2.5);
  ASSERT_TRUE(met.Surface);
  // 0.5 s / tau = w0: s = 0.015. Six halvings of a step of one footprint.
  EXPECT_NEAR(*met.Surface, 2 - 0.05 * options.SurfacePrior / 0.5, Footprint / 64);
  EXPECT_LT(met.Least, 0);
}

TEST(FusedField, ARayThroughEmptySpaceMeetsNothing)
{
  const FlatMap map(2.f, 0.5f);
  const std::vector<View> views{ map.AsView() };
  const auto met = WalkAlongZ(FusedField(views, {}, Footprint), 1, 1.9);
  EXPECT_FALSE(met.Surface);
  EXPECT_GT(met.Least, 0);
}
