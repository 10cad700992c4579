// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/SyntheticRenderer.h"

#include "mesh/ObjectMesh.h"
#include "support/MessageOf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vtkAppendPolyData.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPoints.h>
#include <vtkSphereSource.h>
#include <vtkTriangleFilter.h>

namespace
{
using namespace novelview;
using Eigen::Vector2d;
using Eigen::Vector3d;

const SurfaceLook Grey = { "grey", false, 0 };

/** A camera with everything a pinhole may have: skew, unequal focal lengths, centre off the middle.
 */
Camera CrookedCamera(int width, int height)
{
  Eigen::Matrix3d k;
  k << 900, 7, 0.43 * width, 0, 860, 0.56 * height, 0, 0, 1;
  return LookAt({ 101, 52, 12 }, { 100, 50, 3 }, { 0.1, 1, 0 }, k, width, height);
}

vtkSmartPointer<vtkPolyData> SmallSphere(const Vector3d& centre, double radius)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(centre.x(), centre.y(), centre.z());
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(40);
  sphere->SetPhiResolution(40);
  sphere->Update();
  return sphere->GetOutput();
}

/** Centroid of the coverage within a square around a pixel. */
Vector2d Centroid(const Image<std::uint8_t>& coverage, const Vector2d& around, int half)
{
  Vector2d sum = Vector2d::Zero();
  double weight = 0;
  const int x0 = static_cast<int>(std::lround(around.x()));
  const int y0 = static_cast<int>(std::lround(around.y()));
  for (int y = y0 - half; y <= y0 + half; ++y)
  {
    for (int x = x0 - half; x <= x0 + half; ++x)
    {
      sum += coverage(x, y) * Vector2d(x, y);
      weight += coverage(x, y);
    }
  }
  return sum / weight;
}

TEST(SyntheticRenderer, SpheresAppearWhereTheCameraProjectsThem)
{
  // 1100 pixels of 4 samples make several tiles, whose seams must not show either.
  const Camera camera = CrookedCamera(1100, 620);
  vtkNew<vtkAppendPolyData> all;
  std::vector<Vector2d> expected;
  for (int i = 0; i < 30; ++i)
  {
    const Vector2d pixel(40.3 + 170.7 * (i % 6), 31.6 + 131.2 * (i / 6));
    const double depth = 7 + 0.17 * i;
    const Vector3d centre = camera.Unproject(pixel, depth);
    expected.push_back(pixel);
    all->AddInputData(SmallSphere(centre, 5 * camera.PixelFootprint(depth)));
  }
  all->Update();
  SyntheticRenderer photographer(all->GetOutput(), Grey, 4);
  const RenderedPhotograph photograph = photographer.Take(camera);
  for (const Vector2d& pixel : expected)
  {
    const Vector2d seen = Centroid(photograph.Coverage, pixel, 8);
    // The boundary of each sphere is sampled about 120 times, which leaves 0.25 / sqrt(120) = 0.02
    // px; the perspective drawing-out of a sphere of 5 px moves its centroid by another 0.01 px.
    EXPECT_LT((seen - pixel).norm(), 0.05)
      << "expected " << pixel.transpose() << ", seen " << seen.transpose();
  }
}

TEST(SyntheticRenderer, EdgeCoversPixelsByItsShare)
{
  Eigen::Matrix3d k;
  k << 100, 0, 31.5, 0, 100, 23.5, 0, 0, 1;
  const Camera camera = LookAt({ 0, 0, 10 }, { 0, 0, 0 }, { 0, 1, 0 }, k, 64, 48);
  // From far left to pixel x = 40.25: pixel 40 begins at 39.5 and is covered by three quarters.
  const double right = camera.Unproject({ 40.25, 0 }, 10).x();
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-20, -20, 0);
  plane->SetPoint1(right, -20, 0);
  plane->SetPoint2(-20, 20, 0);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(plane->GetOutputPort());
  triangles->Update();
  SyntheticRenderer photographer(triangles->GetOutput(), Grey, 8);
  const RenderedPhotograph photograph = photographer.Take(camera);
  for (const int y : { 0, 20, 47 })
  {
    EXPECT_EQ(photograph.Coverage(39, y), 255);
    EXPECT_EQ(photograph.Coverage(40, y), 191); // 0.75 * 255, six of eight columns of samples
    EXPECT_EQ(photograph.Coverage(41, y), 0);
    EXPECT_EQ(photograph.Color(39, y, 0), 133); // 0.52 * 255
    EXPECT_NEAR(photograph.Color(40, y, 0), 0.75 * 133, 1) << "the rim blends with black";
    EXPECT_EQ(photograph.Color(41, y, 0), 0);
  }
}

TEST(SyntheticRenderer, TwoViewsAgreeOnTheColourOfAPoint)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1);
  sphere->SetThetaResolution(200);
  sphere->SetPhiResolution(200);
  sphere->Update();
  Eigen::Matrix3d k;
  k << 700, 0, 199.5, 0, 700, 149.5, 0, 0, 1;
  const Camera first = LookAt({ 0, 0, 6 }, { 0, 0, 0 }, { 0, 1, 0 }, k, 400, 300);
  const Camera second = LookAt({ 1.55, 0, 5.8 }, { 0, 0, 0 }, { 0, 1, 0 }, k, 400, 300);
  const std::vector<SurfaceLook> looks = { { "wood", true, 3 }, { "wood", false, 4 },
    { "marble", false, 3 }, { "plaster", true, 3 } };
  for (const SurfaceLook& look : looks)
  {
    SyntheticRenderer photographer(sphere->GetOutput(), look, 4);
    const RenderedPhotograph a = photographer.Take(first);
    const RenderedPhotograph b = photographer.Take(second);
    double apart = 0;
    double shifted = 0;
    int count = 0;
    for (int i = 0; i < 400; ++i)
    {
      // Points that both cameras see at less than 40 degrees.
      const double u = -0.4 + 0.8 * (i % 20) / 19;
      const double v = -0.4 + 0.8 * (i / 20) / 19;
      const Vector3d point = Vector3d(u + 0.12, v, 1).normalized();
      const Vector2d inA = first.Project(point);
      const Vector2d inB = second.Project(point);
      const double colour = SampleBilinear(a.Color.Ref(), inA.x(), inA.y(), 1);
      apart += std::abs(colour - SampleBilinear(b.Color.Ref(), inB.x(), inB.y(), 1));
      shifted += std::abs(colour - SampleBilinear(b.Color.Ref(), inB.x() + 3, inB.y(), 1));
      ++count;
    }
    // What is left is the resampling of grain about two pixels wide; three pixels off, on the other
    // hand, a texture made for matching must look clearly different.
    RecordProperty("apart", std::to_string(apart / count));
    EXPECT_LT(apart / count, 6.0) << look.Texture;
    if (look.Texture != "plaster")
    {
      EXPECT_LT(2 * apart, shifted) << look.Texture;
    }
  }
}

TEST(SyntheticRenderer, MaskIsTheProjectionOfTheMesh)
{
  vtkSmartPointer<vtkPolyData> mesh = LoadObject("stool");
  Eigen::Matrix3d k;
  k << 500, 0, 149.5, 0, 500, 119.5, 0, 0, 1;
  const Camera camera = LookAt({ 2, 1.5, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, k, 300, 240);
  SyntheticRenderer photographer(mesh, Grey, 4);
  const RenderedPhotograph photograph = photographer.Take(camera);

  Eigen::AlignedBox2d projected;
  for (vtkIdType ptId = 0; ptId < mesh->GetNumberOfPoints(); ++ptId)
  {
    const Vector2d pixel = camera.Project(Vector3d(mesh->GetPoint(ptId)));
    projected.extend(pixel);
    const int x = static_cast<int>(std::lround(pixel.x()));
    const int y = static_cast<int>(std::lround(pixel.y()));
    int most = 0; // a vertex on the contour covers next to nothing of its own pixel
    for (int i = 0; i < 9; ++i)
    {
      most = std::max<int>(most, photograph.Coverage(x + i % 3 - 1, y + i / 3 - 1));
    }
    ASSERT_GT(most, 0) << "vertex " << ptId;
  }
  Eigen::AlignedBox2d covered;
  for (int y = 0; y < 240; ++y)
  {
    for (int x = 0; x < 300; ++x)
    {
      if (photograph.Coverage(x, y) > 0)
      {
        covered.extend(Vector2d(x, y));
      }
      else
      {
        ASSERT_EQ(photograph.Color(x, y, 0), 0) << "background is black";
      }
    }
  }
  // A pixel is covered when the projection enters it, within half a pixel of its centre; a sample's
  // eighth of a pixel may be missed.
  EXPECT_LT((covered.min() - projected.min()).cwiseAbs().maxCoeff(), 0.5 + 0.125);
  EXPECT_LT((covered.max() - projected.max()).cwiseAbs().maxCoeff(), 0.5 + 0.125);
}

TEST(SyntheticRenderer, WorksFarFromTheOriginAndInOtherUnits)
{
  // Single precision has no digit left for a millimetre at a hundred kilometres.
  const Vector3d centre(1e8, -2e7, 3e7);
  vtkSmartPointer<vtkPolyData> mesh = SmallSphere({ 0, 0, 0 }, 50);
  vtkNew<vtkPoints> moved;
  moved->SetDataTypeToDouble();
  for (vtkIdType ptId = 0; ptId < mesh->GetNumberOfPoints(); ++ptId)
  {
    const Vector3d point = Vector3d(mesh->GetPoint(ptId)) + centre;
    moved->InsertNextPoint(point.data());
  }
  mesh->SetPoints(moved);
  Eigen::Matrix3d k;
  k << 300, 0, 49.5, 0, 300, 49.5, 0, 0, 1;
  const Camera camera = LookAt(centre + Vector3d(0, 0, 600), centre, { 0, 1, 0 }, k, 100, 100);
  SyntheticRenderer photographer(mesh, Grey, 4);
  const RenderedPhotograph photograph = photographer.Take(camera);
  EXPECT_LT(
    (Centroid(photograph.Coverage, { 49.5, 49.5 }, 45) - Vector2d(49.5, 49.5)).norm(), 0.05);
}

TEST(SyntheticRenderer, SaysWhatIsWrong)
{
  vtkSmartPointer<vtkPolyData> mesh = SmallSphere({ 0, 0, 0 }, 1);
  SyntheticRenderer photographer(mesh, Grey, 1);
  Eigen::Matrix3d k;
  k << 300, 0, 49.5, 0, 300, 49.5, 0, 0, 1;
  const Camera inside = LookAt({ 0, 0, 0.5 }, { 0, 0, 0 }, { 0, 1, 0 }, k, 100, 100);
  EXPECT_THAT(MessageOf([&] { photographer.Take(inside); }),
    testing::HasSubstr("the object is not wholly in front of the camera"));
  EXPECT_THAT(MessageOf([&] { photographer.Take(Camera()); }),
    testing::HasSubstr("image size is not positive"));
  EXPECT_THAT(MessageOf(
                [&] {
                  SyntheticRenderer(mesh, { "velvet", true, 0 }, 1);
                }),
    testing::HasSubstr("there is no such texture (got \"velvet\", expected wood, marble"));
}
}
