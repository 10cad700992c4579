// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/CalibrationCases.h"

using namespace novelview;
using namespace novelview::testing_support;

namespace
{
const Eigen::DiagonalMatrix<double, 3> UpAndBack(1, -1, -1);
const Eigen::DiagonalMatrix<double, 3> Up(1, -1, 1);

CameraConvention Stated(const std::string& axes, const std::string& poses,
  const std::string& order = "row", double centre = 0)
{
  return { axes, poses, order, centre, false, false };
}

/** The camera that a file states so, read in a convention. */
Camera Read(const CameraConvention& convention, const Eigen::Matrix3d& r, const Eigen::Vector3d& t,
  const Camera& like)
{
  std::vector<Photograph> photographs(1);
  photographs[0].Cam = like;
  photographs[0].Cam.R = r;
  photographs[0].Cam.T = t;
  ApplyConvention(convention, photographs);
  return photographs[0].Cam;
}

void ExpectSame(const Camera& a, const Camera& b)
{
  EXPECT_LE((a.K - b.K).norm(), 1e-12);
  EXPECT_LE((a.R - b.R).norm(), 1e-12);
  EXPECT_LE((a.T - b.T).norm(), 1e-12);
}

const Camera Any = RandomPhotographs(5, false, {})[3].Cam;
}

TEST(CameraConvention, EveryWayToStateAPoseIsUnderstood)
{
  const Eigen::Matrix3d r = Any.R;
  const Eigen::Vector3d t = Any.T;
  ExpectSame(Read(Stated("opencv", "world-to-camera"), r, t, Any), Any);
  ExpectSame(Read(Stated("opencv", "world-to-camera", "column"), r.transpose(), t, Any), Any);
  ExpectSame(Read(Stated("opencv", "camera-to-world"), r.transpose(), Any.Centre(), Any), Any);
  // The rotation of one and the centre of the other, as some programs have it.
  ExpectSame(Read(Stated("opencv", "camera-to-world", "column"), r, Any.Centre(), Any), Any);
  ExpectSame(Read(Stated("opengl", "world-to-camera"), UpAndBack * r, UpAndBack * t, Any), Any);
  ExpectSame(
    Read(Stated("opengl", "camera-to-world"), (UpAndBack * r).transpose(), Any.Centre(), Any), Any);
}

TEST(CameraConvention, PixelCentresMoveThePrincipalPoint)
{
  const Camera read = Read(Stated("opencv", "world-to-camera", "row", 0.5), Any.R, Any.T, Any);
  EXPECT_EQ(read.K(0, 2), Any.K(0, 2) - 0.5);
  EXPECT_EQ(read.K(1, 2), Any.K(1, 2) - 0.5);
  EXPECT_EQ(read.K(0, 0), Any.K(0, 0));
}

TEST(CameraConvention, LeftHandedCamerasInARightHandedWorld)
{
  // y of camera and pixels up: v' = Height - 1 - v. R has determinant -1.
  Camera stated = Any;
  stated.K(1, 2) = Any.Height - 1 - Any.K(1, 2);
  CameraConvention convention = ProjectConvention();
  convention.FlipY = true;
  ExpectSame(Read(convention, Up * Any.R, Up * Any.T, stated), Any);
}

TEST(CameraConvention, PhotographsUpsideDownMirrorTheWorld)
{
  // The cameras are right, but the rows of the files run the other way.
  CameraConvention convention = ProjectConvention();
  convention.FlipY = true;
  const Camera read = Read(convention, Any.R, Any.T, Any);
  EXPECT_GT(read.R.determinant(), 0);
  for (const Eigen::Vector3d& ahead :
    { Eigen::Vector3d(0, 0, 5), Eigen::Vector3d(1, 0.5, 6), Eigen::Vector3d(-1, 2, 9) })
  {
    const Eigen::Vector3d point = Any.R.transpose() * (ahead - Any.T);
    const Eigen::Vector2d pixel = Any.Project(point);
    ExpectPixel(read, Up * point, { pixel.x(), Any.Height - 1 - pixel.y() });
  }
}

TEST(CameraConvention, FlippingTurnsTheLens)
{
  Photograph photograph = RandomPhotographs(5, false,
    { Lens::Model::Perspective,
      { 0.1, 0.02, 0.01, -0.02, 0.003, 0, 0, 0, 0.01, 0.02, 0.03, 0.04 } })[0];
  std::vector<Photograph> flipped{ photograph };
  CameraConvention convention = ProjectConvention();
  convention.FlipY = true;
  ApplyConvention(convention, flipped);
  const double bottom = photograph.Cam.Height - 1;
  for (const Eigen::Vector2d& pixel :
    { Eigen::Vector2d(10, 20), Eigen::Vector2d(400, 100), Eigen::Vector2d(600, 470) })
  {
    const Eigen::Vector2d a = Distort(photograph.Distortion, photograph.Cam.K, pixel);
    const Eigen::Vector2d b =
      Distort(flipped[0].Distortion, flipped[0].Cam.K, { pixel.x(), bottom - pixel.y() });
    EXPECT_NEAR(a.x(), b.x(), 1e-9); // rounding
    EXPECT_NEAR(a.y(), bottom - b.y(), 1e-9);
  }
  photograph.Distortion.Coefficients.resize(14, 0.01);
  flipped = { photograph };
  ExpectError([&] { ApplyConvention(convention, flipped); }, "tilted sensor");
}

TEST(CameraConvention, WhatIsGivenGoesOverTheFormats)
{
  CameraConvention own = Stated("opengl", "camera-to-world", "row", 0.5);
  const CameraConvention same = Override(own, {});
  EXPECT_EQ(same.Axes, "opengl");
  EXPECT_EQ(same.PixelCentre, 0.5);
  CameraConvention given;
  given.Axes = "opencv";
  given.PixelCentre = 0;
  given.InvertMasks = true;
  const CameraConvention other = Override(own, given);
  EXPECT_EQ(other.Axes, "opencv");
  EXPECT_EQ(other.Poses, "camera-to-world");
  EXPECT_EQ(other.PixelCentre, 0);
  EXPECT_TRUE(other.InvertMasks);
}

TEST(CameraConvention, WritingIsTheWayBack)
{
  for (const char* axes : { "opencv", "opengl" })
  {
    for (const char* poses : { "world-to-camera", "camera-to-world" })
    {
      for (const char* order : { "row", "column" })
      {
        const CameraConvention convention = Stated(axes, poses, order, 0.5);
        std::vector<Photograph> photographs(1);
        photographs[0].Cam = InConvention(convention, Any);
        ApplyConvention(convention, photographs);
        ExpectSame(photographs[0].Cam, Any);
      }
    }
  }
}

TEST(CameraConvention, ADataSetsFilesCanBeReadInAnotherOne)
{
  // A user wrote OpenCV cameras into transforms.json, world-to-camera, transposed, from pixel 0.
  std::vector<Photograph> photographs = RandomPhotographs(7, true, {});
  std::vector<Photograph> raw = photographs;
  CameraConvention nerf = Stated("opengl", "camera-to-world", "row", 0.5);
  for (Photograph& photograph : raw)
  {
    photograph.Cam.R.transposeInPlace();
    std::vector<Photograph> one{ photograph };
    ApplyConvention(nerf, one); // so that writing it states the numbers above
    photograph.Cam = one[0].Cam;
  }
  const TemporaryFolder folder;
  WriteCalibration(folder.Path, "nerf", raw);
  DatasetSource source;
  source.Convention = Stated("opencv", "world-to-camera", "column", 0);
  ExpectSamePhotographs(ReadDatasetIndex(folder.Path, source).Cameras, photographs, 1e-12);
}

TEST(CameraConvention, WhatCannotBeAppliedIsAnError)
{
  std::vector<Photograph> photographs = RandomPhotographs(7, true, {});
  const TemporaryFolder folder;
  WriteCalibration(folder.Path, "middlebury", photographs);
  DatasetSource source;
  source.Convention.FlipY = true;
  // The calibration does not say the height, so the photograph must.
  ExpectError([&] { ReadDatasetIndex(folder.Path, source); }, "a0.png", "no such file");
  photographs[0].Where = "file, line 1";
  photographs[0].Cam.R.row(0).setZero();
  ExpectError([&] { ApplyConvention(Stated("opencv", "camera-to-world"), photographs); },
    "file, line 1", "singular");
}
