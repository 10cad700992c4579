// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/OutlineViews.h"
#include "support/Expect.h"
#include "support/Scene.h"

#include <algorithm>

using namespace novelview;
using namespace support;

namespace
{
constexpr double Radius = 0.5;

/** A ball with a colour of its own at every place, seen by twelve cameras around it, 30 degrees apart. */
struct BallCase
{
  std::vector<Photo> Photos = TakeAll(
    Sphere(Vector3d::Zero(), Radius),
    [](const Vector3d& p) -> Vector3d
    {
      const auto wave = [](double x) { return 128 + 100 * std::sin(40 * x); };
      return Vector3d(wave(p.x() + p.y()), wave(p.y() - p.z()), wave(p.z() + p.x()));
    },
    Ring(12, 30));
  std::vector<View> Views;
  TriangleMesh Mesh = SphereMesh(Vector3d::Zero(), Radius, 4);
  Camera Novel = OnRing(15);
  OutlineOptions Options;

  BallCase()
  {
    for (const Photo& photo : Photos)
    {
      Views.push_back(photo.AsView());
    }
  }

  /** Of the rim's point to the right of the novel view. */
  OutlineViews Select() const
  {
    const Vector3d right = Novel.R.row(0).transpose();
    const Vector3d point = Radius * right;
    const double footprint = Novel.PixelFootprint(Novel.Depth(point));
    return OutlineViewSelector(Mesh, Views, Novel, Options).Select(point, footprint * right);
  }
};
}

TEST(OutlineViews, TheContourEnergyLooksAtTheNearestWithinTheAngle)
{
  BallCase ball;
  ball.Options.NearViews = 3;
  ball.Options.NearAngleDeg = 44;
  std::vector<int> near = ContourViews(ball.Views, ball.Novel, ball.Options);
  std::sort(near.begin(), near.end());
  EXPECT_EQ(near, (std::vector<int>{ 0, 1 })) << "15 degrees to either side; the next are 45 away";
  ball.Options.NearViews = 1;
  EXPECT_EQ(ContourViews(ball.Views, ball.Novel, ball.Options).size(), 1u);
}

TEST(OutlineViews, TheKeyLiesOnTheMovingSideNearestToTheNovelView)
{
  const BallCase ball;
  const OutlineViews views = ball.Select();
  ASSERT_GE(views.Key, 0);
  const Vector3d right = ball.Novel.R.row(0).transpose();
  const auto facing = [&](int viewId)
  { return right.dot((ball.Views[viewId].Cam.Centre() - Radius * right).normalized()); };
  EXPECT_GE(facing(views.Key), ball.Options.MinFacing);
  for (int viewId = 0; viewId < 12; ++viewId)
  {
    const auto angle = [&](int id)
    { return ball.Views[id].Cam.OpticalAxis().dot(ball.Novel.OpticalAxis()); };
    EXPECT_TRUE(
      facing(viewId) < ball.Options.MinFacing || angle(viewId) <= angle(views.Key) + 1e-9);
  }
  EXPECT_EQ(views.Secondaries.size(), 2u);
  for (const int viewId : views.Secondaries)
  {
    EXPECT_GE(facing(viewId), ball.Options.MinFacing);
    EXPECT_NE(viewId, views.Key);
  }
}

TEST(OutlineViews, AFlatKeyOrOneWithoutNeighboursTellsNothing)
{
  BallCase ball;
  ball.Options.MinVariance = 1e6;
  EXPECT_EQ(ball.Select().Key, -1);
  ball.Options.MinVariance = 0;
  EXPECT_GE(ball.Select().Key, 0);
  ball.Options.MaxApartDeg = 20;
  EXPECT_EQ(ball.Select().Key, -1) << "the next photograph is 30 degrees away";
}

TEST(OutlineViews, PhotographsThatTheMeshHidesThePointFromDoNotTell)
{
  BallCase ball;
  const TriangleMesh larger = SphereMesh(Vector3d::Zero(), 1.5 * Radius, 4);
  ball.Mesh = larger;
  EXPECT_EQ(ball.Select().Key, -1);
}
