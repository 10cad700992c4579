// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/CameraRefinement.h"
#include "calibration/EpipolarDistance.h"
#include "support/CalibrationScene.h"
#include "support/Expect.h"

#include <gtest/gtest.h>

using namespace novelview;
using namespace support;

namespace
{
/** RMS over points of the sphere of how far apart two sets of cameras show them, pixels. */
double Apart(const std::vector<Camera>& some, const std::vector<Camera>& others)
{
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < some.size(); ++i)
  {
    for (const double x : { -0.4, 0.0, 0.4 })
    {
      for (const double y : { -0.4, 0.0, 0.4 })
      {
        const Vector3d point(x, y, 0.2);
        sum += (some[i].Project(point) - others[i].Project(point)).squaredNorm();
        ++count;
      }
    }
  }
  return std::sqrt(sum / count);
}

std::vector<Camera> CamerasOf(const CalibrationScene& scene)
{
  std::vector<Camera> cameras;
  for (const Photo& photo : scene.Photos)
  {
    cameras.push_back(photo.Cam);
  }
  return cameras;
}

bool SameBits(const std::vector<Camera>& some, const std::vector<Camera>& others)
{
  return std::equal(some.begin(), some.end(), others.begin(), others.end(),
    [](const Camera& a, const Camera& b) { return a.K == b.K && a.R == b.R && a.T == b.T; });
}
}

TEST(CameraRefinement, DisturbedCamerasComeBack)
{
  CalibrationScene scene(Waves(0.06));
  scene.Disturb(0.75);
  const std::vector<Camera> given = CamerasOf(scene);
  const CameraRefinement result = RefineCameras(scene.Views());
  ASSERT_TRUE(result.Accepted);
  EXPECT_LT(result.ErrorAfterPx, 0.3 * result.ErrorBeforePx);
  // What is left is the mean of all errors: a turn of the whole world.
  EXPECT_LT(Apart(result.Cameras, scene.True), 0.5 * Apart(given, scene.True));
  for (std::size_t i = 0; i < given.size(); ++i)
  {
    EXPECT_GT(result.ShiftsPx[i], 0);
    EXPECT_EQ(result.Cameras[i].K, given[i].K);
    EXPECT_NO_THROW(ValidateCamera(result.Cameras[i], "refined"));
  }
}

TEST(CameraRefinement, OneCameraThatIsOffIsTheOneThatMoves)
{
  CalibrationScene scene(Waves(0.06));
  Camera& off = scene.Photos[4].Cam;
  const Eigen::Matrix3d r =
    Eigen::AngleAxisd(2 / off.FocalLength(), Vector3d::UnitX()).toRotationMatrix();
  off.R = r * off.R;
  off.T = r * off.T;
  const CameraRefinement result = RefineCameras(scene.Views());
  ASSERT_TRUE(result.Accepted);
  EXPECT_GT(result.ShiftsPx[4], 1.2);
  for (std::size_t i = 0; i < result.ShiftsPx.size(); ++i)
  {
    EXPECT_TRUE(i == 4 || result.ShiftsPx[i] < 0.5 * result.ShiftsPx[4]) << i;
  }
}

TEST(CameraRefinement, ExactCamerasKeepTheirBits)
{
  const CalibrationScene scene(Waves(0.06));
  const CameraRefinement result = RefineCameras(scene.Views());
  EXPECT_FALSE(result.Accepted);
  EXPECT_TRUE(SameBits(result.Cameras, scene.True));
  EXPECT_EQ(result.ShiftsPx, std::vector<double>(12, 0.0));
  EXPECT_EQ(result.ErrorAfterPx, result.ErrorBeforePx);
}

TEST(CameraRefinement, WithoutTextureTheGivenCamerasStay)
{
  CalibrationScene scene(Plain(120, 120, 120));
  scene.Disturb(2);
  const CameraRefinement result = RefineCameras(scene.Views());
  EXPECT_FALSE(result.Accepted);
  EXPECT_TRUE(SameBits(result.Cameras, CamerasOf(scene)));
}

TEST(CameraRefinement, StopsWhenAskedTo)
{
  CalibrationScene scene(Waves(0.06));
  scene.Disturb(0.75);
  Execution execution;
  execution.StopRequested = [] { return true; };
  EXPECT_THROW(RefineCameras(scene.Views(), {}, execution), Interrupted);
}

TEST(CameraRefinement, DoesNotDependOnThreads)
{
  CalibrationScene scene(Waves(0.06));
  scene.Disturb(0.75);
  EXPECT_TRUE(SameBits(
    RefineCameras(scene.Views()).Cameras, RefineCameras(scene.Views(), {}, InThreads(3)).Cameras));
}

TEST(EpipolarDistance, OfHandComputedPixels)
{
  // Two cameras side by side: epipolar lines are rows, and the distance is half of the difference
  // of the rows in each image, sqrt(1/2) of it in both together.
  Camera left;
  left.K << 100, 0, 50, 0, 100, 40, 0, 0, 1;
  left.Width = 100;
  left.Height = 80;
  Camera right = left;
  right.T = Vector3d(-1, 0, 0);
  EXPECT_NEAR(EpipolarDistance(left, { 50, 40 }, right, { 30, 40 }), 0, 1e-12);
  EXPECT_NEAR(EpipolarDistance(left, { 50, 40 }, right, { 30, 42 }), 2 * std::sqrt(0.5), 1e-12);
  EXPECT_EQ(EpipolarDistance(left, { 50, 40 }, left, { 30, 42 }), 0);
}
