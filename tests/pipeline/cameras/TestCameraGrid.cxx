// SPDX-License-Identifier: GPL-3.0-or-later
#include "cameras/CameraGrid.h"
#include "support/CalibrationCases.h"

#include <Eigen/Geometry>

using namespace novelview;
using namespace novelview::testing_support;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
/** Twelve cameras around a point, two units away from it. */
std::vector<Photograph> Ring(const Vector3d& target)
{
  std::vector<Photograph> photographs(12);
  Matrix3d K;
  K << 800.25, 0, 319.5, 0, 800.25, 239.5, 0, 0, 1;
  for (int i = 0; i < 12; ++i)
  {
    const double angle = i * EIGEN_PI / 6 + 0.1;
    const Vector3d from(2 * std::sin(angle), 0.3, 2 * std::cos(angle));
    photographs[i].Cam = LookAt(target + from, target, Vector3d::UnitY(), K, 640, 480);
  }
  return photographs;
}

/** The cameras with their numbers off by about `relative`, each in another way. */
std::vector<Photograph> Disturbed(std::vector<Photograph> photographs, double relative)
{
  int n = 0;
  for (Photograph& photograph : photographs)
  {
    Camera& camera = photograph.Cam;
    const Vector3d target = camera.ToCamera(Vector3d::Zero());
    ++n;
    const Vector3d axis = Vector3d(std::sin(n), std::cos(n), std::sin(3 * n)).normalized();
    camera.R = Eigen::AngleAxisd(relative, axis) * camera.R;
    camera.T = target * (1 + relative * std::cos(5 * n));
    camera.K(0, 0) *= 1 + relative;
  }
  return photographs;
}
}

TEST(CameraGrid, CamerasThatDifferInTheirLastBitsBecomeTheSame)
{
  const auto given = Ring(Vector3d(0.1, -0.2, 0.05));
  const auto other = Disturbed(given, 1e-14);
  const CameraGrid grid(given);
  const CameraGrid otherGrid(other);
  for (std::size_t i = 0; i < given.size(); ++i)
  {
    EXPECT_NE(given[i].Cam.R, other[i].Cam.R);
    const Camera a = grid.Rounded(given[i].Cam);
    const Camera b = otherGrid.Rounded(other[i].Cam);
    EXPECT_EQ(a.R, b.R);
    EXPECT_EQ(a.T, b.T);
    EXPECT_EQ(a.K, b.K);
    const Camera again = grid.Rounded(a);
    EXPECT_EQ(again.R, a.R);
    EXPECT_EQ(again.T, a.T);
  }
}

TEST(CameraGrid, NothingMovesInTheImage)
{
  // The second is where maps put objects: far from the origin of the world.
  for (const Vector3d& target : { Vector3d(0.1, -0.2, 0.05), Vector3d(5.4e6, -3.1e6, 120) })
  {
    const auto given = Ring(target);
    const CameraGrid grid(given);
    for (const Photograph& photograph : given)
    {
      const Camera rounded = grid.Rounded(photograph.Cam);
      for (const Vector3d& offset : { Vector3d(0.5, 0, 0), Vector3d(0, -0.4, 0.3) })
      {
        EXPECT_LT(
          (rounded.Project(target + offset) - photograph.Cam.Project(target + offset)).norm(),
          1e-3);
      }
    }
  }
}

TEST(CameraGrid, RotationsToFewDigitsBecomeExactWithoutMovingTheObject)
{
  const Vector3d target(700, 0, 900); // of the size at which a wrong rotation alone would show
  auto given = Ring(target);
  for (Photograph& photograph : given)
  {
    Matrix3d& R = photograph.Cam.R;
    R = (R * 1e6).array().round().matrix() / 1e6;
    photograph.Cam.T = Vector3d(0, 0, 2) - R * target;
  }
  const CameraGrid grid(given);
  for (const Photograph& photograph : given)
  {
    const Camera exact = grid.WithRotation(photograph.Cam);
    EXPECT_LT((exact.R * exact.R.transpose() - Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_LT((exact.Project(target) - photograph.Cam.Project(target)).norm(), 1e-3);
    // And what is written from it is read as the same camera.
    EXPECT_EQ(grid.Rounded(exact).R, grid.Rounded(photograph.Cam).R);
    EXPECT_EQ(grid.Rounded(exact).T, grid.Rounded(photograph.Cam).T);
  }
}

TEST(CameraGrid, ACameraAtTheTargetStays)
{
  const CameraGrid grid({});
  EXPECT_EQ(grid.Rounded(Camera()).R, Matrix3d::Identity());
}
