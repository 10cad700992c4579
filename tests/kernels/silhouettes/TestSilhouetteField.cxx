// SPDX-License-Identifier: GPL-3.0-or-later
#include "silhouettes/SilhouetteField.h"
#include "support/Expect.h"
#include "support/SphereScene.h"

#include <limits>
#include <random>

using namespace novelview;
using namespace support;

namespace
{
/** Classifies random balls and looks the field up in each that is said to be certain. */
void ExpectClassificationHolds(const std::vector<Camera>& cameras, double reach, int atLeast,
  const std::optional<Eigen::AlignedBox3d>& bounds = {})
{
  const auto photos = TakeAll(Sphere(Vector3d::Zero(), Radius), Plain(200, 200, 200), cameras);
  const auto views = ViewsOf(photos);
  const SilhouetteField field(views, bounds);
  const auto offsets = RandomPoints(64, 1, 5);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(0.01, 0.6 * reach);
  int certain = 0;
  for (const Vector3d& centre : RandomPoints(8000, reach, 4))
  {
    const double radius = uniform(random);
    const auto position = field.Classify(centre, radius);
    if (position == SilhouetteField::Position::Mixed)
    {
      continue;
    }
    ++certain;
    for (const Vector3d& offset : offsets)
    {
      const bool inside = field.Value(centre + radius * offset.normalized()) >= 0;
      ASSERT_EQ(inside, position == SilhouetteField::Position::Inside)
        << centre.transpose() << " radius " << radius;
    }
  }
  EXPECT_GT(certain, atLeast);
}
}

TEST(SilhouetteField, ClassifiesABallOnlyWhenAllOfItIsThere)
{
  std::vector<Camera> cameras = Ring(3, 60);
  cameras[1].K(0, 2) += 75;
  cameras[2].K(0, 0) *= 1.6; // pixels that are not square
  ExpectClassificationHolds(cameras, 2.5, 800);
}

TEST(SilhouetteField, ClassifiesBallsFarOffTheAxisOfAWideAngleCamera)
{
  // Half of the sphere and more lies outside these frames, at steep angles to the axis.
  std::vector<Camera> cameras;
  for (const double angle : { 0.0, 100.0 })
  {
    cameras.push_back(OnRing(angle, 0, 1.2, SmallPictureK(60)));
    cameras.back().Width = 80;
    cameras.back().K(0, 2) = 75;
  }
  ExpectClassificationHolds(cameras, 2.5, 200);
}

TEST(SilhouetteField, ClassifiesBallsAboutTheBoxThatBoundsIt)
{
  const Eigen::AlignedBox3d box(Vector3d(-0.4, -0.1, -2), Vector3d(0.1, 0.2, 2));
  ExpectClassificationHolds(Ring(3, 60), 1, 800, box);
}

TEST(SilhouetteField, ABoxBoundsItLikeAFurtherView)
{
  const auto views = ViewsOf(SpherePhotos());
  const SilhouetteField bounded(
    views, Eigen::AlignedBox3d(Vector3d(-1, -0.1, -1), Vector3d(1, 1, 1)));
  EXPECT_NEAR(bounded.Value(Vector3d::Zero()), 0.1, 1e-12);
  EXPECT_NEAR(bounded.Value(Vector3d(0, -0.15, 0)), -0.05, 1e-12);
  const Vector3d nearTop(0, 0.9 * Radius, 0);
  EXPECT_EQ(bounded.Value(nearTop), SilhouetteField(views).Value(nearTop));
}

TEST(SilhouetteField, ValueIsTheLeastConeDistanceInWorldUnits)
{
  const auto views = ViewsOf(SpherePhotos());
  const SilhouetteField field(views);
  // At the middle the nearest cone is about the sphere's radius away; a pixel of tolerance.
  EXPECT_NEAR(field.Value(Vector3d::Zero()), Radius, 4 / Focal);
  int deciding = 7;
  EXPECT_EQ(field.Value(Vector3d(0, 50, 0), deciding), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(deciding, -1);
}
