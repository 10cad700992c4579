// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/Camera.h"
#include "support/Expect.h"

#include <cmath>
#include <utility>

using namespace novelview;
using Eigen::Vector2d;
using Eigen::Vector3d;
using support::ExpectError;

namespace
{
Camera OnCircle(double angleDeg, double elevationDeg = 0)
{
  const double a = angleDeg * EIGEN_PI / 180;
  const double e = elevationDeg * EIGEN_PI / 180;
  const Vector3d centre(
    3 * std::sin(a) * std::cos(e), 3 * std::sin(e), 3 * std::cos(a) * std::cos(e));
  Eigen::Matrix3d k;
  k << 500, 2, 319.5, 0, 510, 239.5, 0, 0, 1;
  return LookAt(centre + Vector3d(1, 2, 3), Vector3d(1, 2, 3), Vector3d::UnitY(), k, 640, 480);
}
}

TEST(Camera, ProjectsAHandComputedPoint)
{
  Camera camera;
  camera.K << 100, 0, 50, 0, 200, 40, 0, 0, 1;
  camera.T = Vector3d(0, 0, 2);
  camera.Width = 100;
  camera.Height = 80;
  // x_cam = (1, 2, 4): u = 100 * 1/4 + 50, v = 200 * 2/4 + 40.
  EXPECT_EQ(camera.Project(Vector3d(1, 2, 2)), Vector2d(75, 140));
  EXPECT_EQ(camera.Centre(), Vector3d(0, 0, -2));
  EXPECT_DOUBLE_EQ(camera.Depth(Vector3d(1, 2, 2)), 4);
}

TEST(Camera, UnprojectUndoesProject)
{
  const Camera camera = OnCircle(33, 20);
  const Vector3d point(1.2, 2.1, 2.9);
  const Vector3d back = camera.Unproject(camera.Project(point), camera.Depth(point));
  EXPECT_LT((back - point).norm(), 1e-12);
  const Vector3d ray = camera.RayDirection(camera.Project(point));
  EXPECT_LT(ray.cross(point - camera.Centre()).norm(), 1e-12);
}

TEST(Camera, FrameReachesHalfAPixelBeyondTheOuterCentres)
{
  const Camera camera = OnCircle(0);
  EXPECT_TRUE(camera.InFrame(Vector2d(-0.5, -0.5)));
  EXPECT_TRUE(camera.InFrame(Vector2d(639.4, 479.4)));
  EXPECT_FALSE(camera.InFrame(Vector2d(639.5, 100)));
  EXPECT_FALSE(camera.InFrame(Vector2d(100, -0.51)));
}

TEST(Camera, LookAtPutsTheTargetInTheMiddleAndUpUpwards)
{
  const Camera camera = OnCircle(45);
  EXPECT_LT((camera.Project(Vector3d(1, 2, 3)) - Vector2d(319.5, 239.5)).norm(), 1e-9);
  EXPECT_LT(camera.Project(Vector3d(1, 2.5, 3)).y(), 239.5);
  EXPECT_NEAR(camera.R.determinant(), 1, 1e-12);
}

TEST(Camera, InterpolationOnAnOrbitStaysOnTheCircle)
{
  for (const double elevation : { 0.0, 35.0 })
  {
    const Camera between = InterpolateOnOrbit(OnCircle(0, elevation), OnCircle(30, elevation), 0.5);
    const Camera expected = OnCircle(15, elevation);
    EXPECT_LT((between.Centre() - expected.Centre()).norm(), 1e-9);
    EXPECT_LT((between.R - expected.R).norm(), 1e-9);
  }
}

TEST(Camera, InterpolationEndsAtBothCameras)
{
  const Camera a = OnCircle(10);
  const Camera b = OnCircle(70, 15);
  EXPECT_LT((InterpolateOnOrbit(a, b, 0).R - a.R).norm(), 1e-9);
  EXPECT_LT((InterpolateOnOrbit(a, b, 1).Centre() - b.Centre()).norm(), 1e-9);
}

TEST(Camera, InterpolationSeesThroughPhotographsTurnedUpsideDown)
{
  const Camera a = OnCircle(0);
  Camera b = OnCircle(30);
  const Eigen::Matrix3d half = Eigen::AngleAxisd(EIGEN_PI, Vector3d::UnitZ()).toRotationMatrix();
  b.R = half * b.R;
  b.T = half * b.T;
  EXPECT_LT((InterpolateOnOrbit(a, b, 0.5).Centre() - OnCircle(15).Centre()).norm(), 1e-9);
}

TEST(Camera, CommonTargetIsWhatTheRigLooksAt)
{
  const Camera cameras[] = { OnCircle(0), OnCircle(30), OnCircle(60, 10) };
  EXPECT_LT((CommonTarget(cameras, 3) - Vector3d(1, 2, 3)).norm(), 1e-9);
}

TEST(Camera, BadCalibrationIsNamed)
{
  Camera good = OnCircle(0);
  EXPECT_NO_THROW(ValidateCamera(good, "view 3"));
  Camera bad = good;
  bad.K(0, 0) = 0;
  ExpectError([&] { ValidateCamera(bad, "view 3"); }, "view 3: camera matrix K is singular");
  bad = good;
  bad.R.row(0) *= -1;
  ExpectError([&] { ValidateCamera(bad, "view 3"); }, "R is not a rotation");
  bad = good;
  bad.T.x() = std::nan("");
  ExpectError([&] { ValidateCamera(bad, "view 3"); }, "not finite");
  bad = good;
  bad.R(0, 0) = 1e308;
  ExpectError([&] { ValidateCamera(bad, "view 3"); }, "R is not a rotation");
  bad = good;
  bad.Width = 0;
  ExpectError([&] { ValidateCamera(bad, "view 3"); }, "got 0x480");
}

TEST(Camera, NumbersThatOverflowAreOutOfRange)
{
  Camera camera = OnCircle(0);
  camera.Width = 640;
  camera.Height = 480;
  const auto refused = [&](double& number, double value, const auto&... parts)
  {
    const double old = std::exchange(number, value);
    ExpectError([&] { ValidateCamera(camera, "view 3"); }, "view 3: ", parts...);
    number = old;
  };
  refused(camera.K(0, 0), 1e308, "focal length fx", "got 1e+308, expected 0.64 to 6.4e+06");
  refused(camera.K(1, 1), 1e-300, "focal length fy is out of range");
  refused(camera.K(0, 1), -1e8, "skew is out of range");
  refused(camera.K(0, 2), -1e308, "principal point cx", "expected -640000 to 640000");
  refused(camera.K(1, 2), 1e308, "principal point cy is out of range");
  refused(camera.T.y(), -1e13, "translation", "got 1e+13, expected 0 to 1e+12");
  EXPECT_NO_THROW(ValidateCamera(camera, ""));
  // As long as the size is not known, whatever fits the largest picture will do.
  camera.Width = camera.Height = 0;
  camera.K(0, 2) = 1e9;
  EXPECT_NO_THROW(ValidateCalibration(camera, ""));
  camera.K(0, 2) = 1e10;
  ExpectError([&] { ValidateCalibration(camera, "view 3"); }, "principal point cx is out of range");
}
