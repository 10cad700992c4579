// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/VtkScene.h"
#include "vtkPinholeCamera.h"

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>

using namespace novelview;
using namespace support;

namespace
{
/** Unequal focal lengths, skew, principal point off the middle. */
Camera OddCamera()
{
  Eigen::Matrix3d k;
  k << 410, 7, 60, 0, 390, 75, 0, 0, 1;
  return OnRing(35, 20, 4, k, 160, 120);
}

/** Pixel at which a vtkCamera shows a point, and its normalised depth (-1 near, 1 far). */
Vector2d PixelOf(vtkCamera* camera, const Vector3d& point, int width, int height, double& depth)
{
  vtkMatrix4x4* matrix =
    camera->GetCompositeProjectionTransformMatrix(static_cast<double>(width) / height, -1, 1);
  const double in[4] = { point.x(), point.y(), point.z(), 1 };
  double out[4];
  matrix->MultiplyPoint(in, out);
  depth = out[2] / out[3];
  // Normalised x runs over the frame [-0.5, width - 0.5), y upwards.
  return { (out[0] / out[3] + 1) / 2 * width - 0.5, (1 - out[1] / out[3]) / 2 * height - 0.5 };
}
}

TEST(PinholeCamera, AVtkCameraSetUpFromItProjectsLikeIt)
{
  const Camera camera = OddCamera();
  vtkNew<vtkCamera> shown;
  NewPinholeCamera(camera)->CopyToVTKCamera(shown, 2, 6);
  for (const Vector3d& point :
    { Vector3d(0, 0, 0), Vector3d(0.3, -0.2, 0.4), Vector3d(-0.5, 0.4, -0.6) })
  {
    double depth = 0;
    const Vector2d pixel = PixelOf(shown, point, camera.Width, camera.Height, depth);
    EXPECT_LT((pixel - camera.Project(point)).norm(), 1e-9);
    EXPECT_GT(depth, -1);
    EXPECT_LT(depth, 1);
  }
  double depth = 0;
  PixelOf(shown, camera.Unproject(Vector2d(80, 60), 2), 160, 120, depth);
  EXPECT_NEAR(depth, -1, 1e-9);
  PixelOf(shown, camera.Unproject(Vector2d(80, 60), 6), 160, 120, depth);
  EXPECT_NEAR(depth, 1, 1e-9);
}

TEST(PinholeCamera, TakenOverFromAVtkCameraItProjectsLikeThat)
{
  vtkNew<vtkCamera> camera;
  camera->SetPosition(1, 2, 5);
  camera->SetFocalPoint(0.1, 0.2, 0.3);
  camera->SetViewUp(0.1, 1, 0);
  camera->SetClippingRange(1, 20);
  for (const bool horizontal : { false, true })
  {
    camera->SetUseHorizontalViewAngle(horizontal);
    camera->SetViewAngle(40);
    vtkNew<vtkPinholeCamera> pinhole;
    pinhole->CopyFromVTKCamera(camera, 160, 120);
    const Vector3d point(0.4, -0.3, 0.5);
    double depth = 0;
    const Vector2d expected = PixelOf(camera, point, 160, 120, depth);
    EXPECT_LT((ToCamera(pinhole).Project(point) - expected).norm(), 1e-9);
  }
}

TEST(PinholeCamera, ToAVtkCameraAndBackIsTheSameCamera)
{
  const Camera camera = OnRing(35, 20); // square pixels, principal point in the middle
  vtkNew<vtkCamera> shown;
  NewPinholeCamera(camera)->CopyToVTKCamera(shown, 2, 6);
  vtkNew<vtkPinholeCamera> back;
  back->CopyFromVTKCamera(shown, camera.Width, camera.Height);
  EXPECT_LT((ToCamera(back).K - camera.K).norm(), 1e-9);
  EXPECT_LT((ToCamera(back).R - camera.R).norm(), 1e-9);
  EXPECT_LT((ToCamera(back).T - camera.T).norm(), 1e-9);
}

TEST(PinholeCamera, DeepCopyTakesEverything)
{
  const auto from = NewPinholeCamera(OddCamera());
  vtkNew<vtkPinholeCamera> to;
  const vtkMTimeType before = to->GetMTime();
  to->DeepCopy(from);
  EXPECT_GT(to->GetMTime(), before);
  EXPECT_EQ(ToCamera(to).K, OddCamera().K);
  EXPECT_EQ(ToCamera(to).R, OddCamera().R);
  EXPECT_EQ(ToCamera(to).T, OddCamera().T);
  EXPECT_EQ(to->GetImageSize()[0], 160);
  EXPECT_EQ(to->GetImageSize()[1], 120);
  double centre[3];
  to->GetCentre(centre);
  EXPECT_LT((Vector3d(centre) - OddCamera().Centre()).norm(), 1e-12);
}

TEST(PinholeCamera, LooksAtItsTargetAndKeepsMatrixAndSize)
{
  const auto camera = NewPinholeCamera(OddCamera());
  const double centre[3] = { 3, 4, 5 };
  const double target[3] = { 1, 1, 1 };
  const double up[3] = { 0, 1, 0 };
  camera->LookAt(centre, target, up);
  const Camera placed = ToCamera(camera);
  EXPECT_LT((placed.Centre() - Vector3d(centre)).norm(), 1e-12);
  // The optical axis meets the picture in the principal point, and up is towards its first row.
  const Vector2d principal = OddCamera().K.col(2).head<2>();
  EXPECT_LT((placed.Project(Vector3d(target)) - principal).norm(), 1e-9);
  EXPECT_LT(placed.Project(Vector3d(1, 1.1, 1)).y(), principal.y());
  EXPECT_EQ(placed.K, OddCamera().K);
  EXPECT_EQ(placed.Width, OddCamera().Width);
}

TEST(PinholeCamera, BetweenTwoCamerasOfARingIsTheOneOnTheRing)
{
  vtkNew<vtkPinholeCamera> between;
  between->InterpolateOnOrbit(
    NewPinholeCamera(OnRing(0, 20)), NewPinholeCamera(OnRing(40, 20)), 0.25);
  EXPECT_LT((ToCamera(between).R - OnRing(10, 20).R).norm(), 1e-9);
  EXPECT_LT((ToCamera(between).T - OnRing(10, 20).T).norm(), 1e-9);
}

TEST(PinholeCamera, PrintsEveryMember)
{
  ExpectPrints(
    NewPinholeCamera(OddCamera()), { "CameraMatrix", "Rotation", "Translation", "ImageSize" });
  EXPECT_THAT(
    Printed(NewPinholeCamera(OddCamera())), testing::HasSubstr("410 7 60 0 390 75 0 0 1"));
}
