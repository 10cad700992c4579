// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/CameraPath.h"
#include "support/Expect.h"

using namespace novelview;
using Eigen::Vector3d;
using support::ExpectError;

namespace
{
const Vector3d Middle(1, 2, 3);

Eigen::Matrix3d Lens(double focal = 500)
{
  Eigen::Matrix3d k;
  k << focal, 0, 319.5, 0, focal, 239.5, 0, 0, 1;
  return k;
}

/** A camera on a tilted turntable, looking a little past its middle. */
Camera OnTable(double angleDeg, double elevationDeg = 20, double distance = 3)
{
  const Eigen::Matrix3d tilt =
    Eigen::AngleAxisd(0.4, Vector3d(1, 0.5, 0.2).normalized()).toRotationMatrix();
  const double a = angleDeg * EIGEN_PI / 180;
  const double e = elevationDeg * EIGEN_PI / 180;
  const Vector3d out(std::cos(e) * std::cos(a), std::sin(e), -std::cos(e) * std::sin(a));
  const Vector3d past(0.05 * std::sin(a), 0.02, 0.05 * std::cos(a));
  return LookAt(Middle + tilt * (distance * out), Middle + tilt * past, tilt * Vector3d::UnitY(),
    Lens(), 640, 480);
}

std::vector<Camera> Table(int count, double stepDeg)
{
  std::vector<Camera> cameras;
  for (int i = 0; i < count; ++i)
  {
    cameras.push_back(OnTable(i * stepDeg));
  }
  return cameras;
}

/** How much two cameras differ: their rotations' entries and their centres. */
double Apart(const Camera& a, const Camera& b)
{
  return std::max(
    (a.R - b.R).cwiseAbs().maxCoeff(), (a.Centre() - b.Centre()).cwiseAbs().maxCoeff());
}
}

TEST(CameraRing, OfATurntableGoesThroughItsCameras)
{
  for (const double stepDeg : { 30.0, -30.0, 150.0 })
  {
    const CameraRing ring = FitCameraRing(Table(12, stepDeg));
    // From the first camera towards the second, by the shorter way.
    const double sign = stepDeg < 0 ? -1 : 1;
    for (const double turn : { 0.0, 0.25, 1.0 / 3, 0.5, 0.9 })
    {
      // Rounding of numbers around 1 in a fit of a dozen cameras.
      EXPECT_LT(Apart(ring.At(turn), OnTable(360 * turn * sign)), 1e-9) << stepDeg << " " << turn;
    }
    EXPECT_EQ(ring.At(0.5).Width, 640);
    EXPECT_TRUE(ring.At(0.5).K.isApprox(Lens(), 1e-12));
  }
}

TEST(CameraRing, TakesTheMeanHeightAndDistance)
{
  std::vector<Camera> cameras;
  for (int i = 0; i < 12; ++i)
  {
    cameras.push_back(OnTable(30 * i, 20, i % 2 ? 3.1 : 2.9));
  }
  const CameraRing ring = FitCameraRing(cameras);
  // Half of the cameras a thirtieth nearer, half further: the circle lies between, where a camera
  // at the mean distance is, to second order of the thirtieth.
  EXPECT_NEAR(ring.Radius, 3 * std::cos(20 * EIGEN_PI / 180), 0.005);
  EXPECT_LT(Apart(ring.At(0), OnTable(0)), 0.02);
}

TEST(CameraRing, SeesThroughPhotographsTurnedByQuarters)
{
  std::vector<Camera> cameras = Table(8, 45);
  const Eigen::Matrix3d half = Eigen::AngleAxisd(EIGEN_PI, Vector3d::UnitZ()).toRotationMatrix();
  for (int i = 1; i < 8; i += 2)
  {
    cameras[i].R = half * cameras[i].R;
    cameras[i].T = half * cameras[i].T;
  }
  EXPECT_LT(Apart(FitCameraRing(cameras).At(0.125), OnTable(45)), 1e-9);
}

TEST(CameraRing, WhatIsNoneIsRefused)
{
  ExpectError([] { FitCameraRing(Table(2, 30)); }, "too few (got 2, expected at least 3)");
  ExpectError([] { FitCameraRing(Table(6, 30)); }, "a part of the circle is without one (got 210");
  ExpectError(
    []
    {
      std::vector<Camera> cameras = Table(12, 30);
      cameras.push_back(OnTable(0, 70));
      FitCameraRing(cameras);
    },
    "one is far off the others' circle");
  ExpectError(
    []
    {
      std::vector<Camera> cameras = Table(12, 30);
      const Vector3d centre = cameras[4].Centre();
      cameras[4].R = Eigen::AngleAxisd(1, Vector3d::UnitX()) * cameras[4].R;
      cameras[4].T = -(cameras[4].R * centre);
      FitCameraRing(cameras);
    },
    "one looks elsewhere than the others");
  ExpectError(
    []
    {
      std::vector<Camera> cameras(3, OnTable(0));
      cameras[1].T.x() += 1;
      cameras[2].T.x() += 2;
      FitCameraRing(cameras);
    },
    "on a line or at one place");
}

//------------------------------------------------------------------------------
TEST(CameraPath, PassesItsKeysAtTheirTimes)
{
  const std::vector<KeyCamera> keys = { { 0, OnTable(0) }, { 1, OnTable(40) }, { 4, OnTable(70) } };
  for (const bool closed : { false, true })
  {
    const CameraPath path(keys, closed);
    for (const KeyCamera& key : keys)
    {
      EXPECT_LT(Apart(path.At(key.Time), key.Cam), 1e-12);
    }
    EXPECT_LT(Apart(path.At(-5), keys[0].Cam), 1e-12);
    EXPECT_LT(Apart(path.At(99), keys[closed ? 0 : 2].Cam), 1e-12);
    EXPECT_EQ(path.End(), closed ? 6 : 4); // two steps in 4, so the way back takes 2
  }
}

TEST(CameraPath, BetweenTwoKeysIsTheStraightWay)
{
  Camera to = OnTable(0);
  const Eigen::AngleAxisd turn(0.8, Vector3d::UnitY());
  to.R = turn * to.R;
  to.T = -(to.R * (OnTable(0).Centre() + Vector3d(4, 0, 0)));
  to.K = Lens(900);
  const CameraPath path({ { 10, OnTable(0) }, { 20, to } });
  const Camera quarter = path.At(12.5);
  EXPECT_LT((quarter.Centre() - OnTable(0).Centre() - Vector3d(1, 0, 0)).norm(), 1e-12);
  const Eigen::Matrix3d expected = Eigen::AngleAxisd(0.2, Vector3d::UnitY()) * OnTable(0).R;
  EXPECT_LT((quarter.R - expected).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_DOUBLE_EQ(quarter.K(0, 0), 600);
}

TEST(CameraPath, DoesNotJerkAtItsKeys)
{
  const CameraPath path(
    { { 0, OnTable(0) }, { 1, OnTable(50) }, { 3, OnTable(80) }, { 3.5, OnTable(170) } }, true);
  const double h = 1e-6;
  for (const double time : { 1.0, 3.0, 3.5 })
  {
    const Vector3d before = (path.At(time).Centre() - path.At(time - h).Centre()) / h;
    const Vector3d after = (path.At(time + h).Centre() - path.At(time).Centre()) / h;
    // Differences over h are off by h times the acceleration, which is below 1e2 here.
    EXPECT_LT((before - after).norm(), 1e-3) << time;
  }
  // And where it closes.
  const Vector3d before = (path.At(path.End()).Centre() - path.At(path.End() - h).Centre()) / h;
  const Vector3d after = (path.At(h).Centre() - path.At(0).Centre()) / h;
  EXPECT_LT((before - after).norm(), 1e-3);
}

TEST(CameraPath, RefusesTooFewKeysAndTimesThatGoBack)
{
  ExpectError([] { CameraPath({ { 0, OnTable(0) } }); }, "too few key cameras (got 1");
  ExpectError(
    [] {
      CameraPath({ { 1, OnTable(0) }, { 1, OnTable(5) } });
    },
    "key 1 is not after the one before it");
}
