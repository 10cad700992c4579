// SPDX-License-Identifier: GPL-3.0-or-later
#include "ViewAccess.h"
#include "support/Expect.h"
#include "support/VtkScene.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkSphereSource.h>
#include <vtkStripper.h>
#include <vtkUnsignedCharArray.h>

using namespace novelview;
using namespace support;

namespace
{
std::vector<Photo> TwoPhotos()
{
  return TakeAll(Sphere(Vector3d::Zero(), 0.5), Waves(0.4), { OnRing(0), OnRing(30) });
}

ViewNeeds Everything()
{
  ViewNeeds needs;
  needs.Color = needs.ContourDistance = true;
  return needs;
}

vtkImageData* BlockOf(vtkMultiBlockDataSet* views, unsigned int viewId)
{
  return vtkImageData::SafeDownCast(views->GetBlock(viewId));
}
}

TEST(ViewAccess, TheFirstRowOfAViewIsTheLastOfTheVtkImage)
{
  const auto image = NewImage(3, 2);
  const auto rows = AddTopDownArray<unsigned char>(image, "Values", 1);
  for (int y = 0; y < 2; ++y)
  {
    for (int x = 0; x < 3; ++x)
    {
      rows(x, y) = static_cast<unsigned char>(10 * y + x);
    }
  }
  auto* array = vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetArray("Values"));
  ASSERT_TRUE(array);
  // VTK's point ids run from the bottom row up.
  const int bottomUp[6] = { 10, 11, 12, 0, 1, 2 };
  for (int ptId = 0; ptId < 6; ++ptId)
  {
    EXPECT_EQ(array->GetValue(ptId), bottomUp[ptId]);
  }
  const auto again = TopDownArray<const unsigned char>(image, "Values", 1, "test", true);
  EXPECT_EQ(again(2, 1), 12);
  EXPECT_EQ(again(0, 0), 0);
}

TEST(ViewAccess, CopyToArrayTurnsColourRowsOver)
{
  Image<unsigned char> picture(2, 2, 3);
  picture(1, 0, 2) = 77; // right pixel of the top row, blue
  const auto image = NewImage(2, 2);
  CopyToArray(picture, "Color", image);
  auto* array = image->GetPointData()->GetArray("Color");
  EXPECT_EQ(array->GetNumberOfComponents(), 3);
  EXPECT_EQ(array->GetComponent(3, 2), 77); // point (1, 1) of the bottom-up image
}

TEST(ViewAccess, ViewsComeBackAsTheyWereWritten)
{
  const auto photos = TwoPhotos();
  const auto blocks = ToBlocks(photos);
  const auto views = ReadViews(blocks, Everything(), 2);
  ASSERT_EQ(views.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_EQ(views[i].Name, photos[i].Name);
    EXPECT_EQ(views[i].Cam.K, photos[i].Cam.K);
    EXPECT_EQ(views[i].Cam.R, photos[i].Cam.R);
    EXPECT_EQ(views[i].Cam.T, photos[i].Cam.T);
    EXPECT_TRUE(views[i].DepthMap.Empty());
    for (int y = 0; y < 120; y += 7)
    {
      for (int x = 0; x < 160; x += 3)
      {
        EXPECT_EQ(views[i].Color(x, y, 1), photos[i].Color(x, y, 1));
        EXPECT_EQ(views[i].Mask(x, y), photos[i].Mask(x, y));
        EXPECT_EQ(views[i].ContourDistance(x, y), photos[i].ContourDistance(x, y));
      }
    }
  }
}

TEST(ViewAccess, MissingArraysAreNamed)
{
  const auto views = ToBlocks(TwoPhotos());
  BlockOf(views, 1)->GetPointData()->RemoveArray("ContourDistance");
  ExpectError(
    [&] { ReadViews(views, Everything()); }, "view 1 (p1): point array ContourDistance is missing");
  ViewNeeds masksOnly;
  EXPECT_NO_THROW(ReadViews(views, masksOnly));
  BlockOf(views, 0)->GetPointData()->RemoveArray("Mask");
  ExpectError([&] { ReadViews(views, masksOnly); }, "view 0 (p0): point array Mask is missing");
}

TEST(ViewAccess, ArraysOfTheWrongTypeOrLengthAreNamed)
{
  const auto views = ToBlocks(TwoPhotos());
  vtkNew<vtkDoubleArray> doubles;
  doubles->SetName("ContourDistance");
  doubles->SetNumberOfTuples(160 * 120);
  BlockOf(views, 0)->GetPointData()->AddArray(doubles);
  ExpectError([&] { ReadViews(views, Everything()); },
    "view 0 (p0): point array ContourDistance has the wrong type (got double x 1");
  vtkNew<vtkFloatArray> tooShort;
  tooShort->SetName("ContourDistance");
  tooShort->SetNumberOfTuples(12);
  BlockOf(views, 0)->GetPointData()->AddArray(tooShort);
  ExpectError([&] { ReadViews(views, Everything()); },
    "ContourDistance has the wrong length (got 12, expected 19200)");
}

TEST(ViewAccess, AMissingOrBadCameraIsNamed)
{
  const auto views = ToBlocks(TwoPhotos());
  BlockOf(views, 1)->GetFieldData()->RemoveArray("Rotation");
  ExpectError([&] { ReadViews(views, {}); },
    "view 1 (p1): field array Rotation is missing or has the wrong length (got none, expected 9)");
  Camera mirrored = OnRing(0);
  mirrored.R.row(0) *= -1;
  AttachCamera(BlockOf(views, 1), mirrored);
  ExpectError([&] { ReadViews(views, {}); }, "view 1 (p1): R is not a rotation");
}

TEST(ViewAccess, AnExposureGainIsReadAndMustBePositive)
{
  const auto views = ToBlocks(TwoPhotos());
  AttachNumber(BlockOf(views, 1), arrays::ExposureGain, 1.25);
  EXPECT_EQ(ReadViews(views, {})[0].Gain, 1) << "none attached";
  EXPECT_EQ(ReadViews(views, {})[1].Gain, 1.25);
  for (const double gain : { 0.0, -1.5, std::nan("") })
  {
    AttachNumber(BlockOf(views, 1), arrays::ExposureGain, gain);
    ExpectError([&] { ReadViews(views, {}); },
      "view 1 (p1): ExposureGain is out of range (got " + std::to_string(gain) +
        ", expected more than 0)");
  }
}

TEST(ViewAccess, NumbersOfTheWholeComeBackOrTheirDefault)
{
  const auto views = ToBlocks(TwoPhotos());
  EXPECT_EQ(AttachedNumber(views, arrays::DepthNoise, 7), 7);
  AttachNumber(views, arrays::DepthNoise, 0.3);
  AttachNumber(views, arrays::DepthNoise, 0.4); // replaced
  EXPECT_EQ(AttachedNumber(views, arrays::DepthNoise, 7), 0.4);
  EXPECT_EQ(AttachedNumber(nullptr, arrays::DepthNoise, 7), 7);
}

TEST(ViewAccess, TablesComeBackRowByRow)
{
  vtkNew<vtkMultiBlockDataSet> views;
  EXPECT_TRUE(AttachedTable(views, "Table", 2).empty());
  AttachTable(views, "Table", { 1, 2, 3, 4, 5, 6 }, 2);
  EXPECT_EQ(views->GetFieldData()->GetArray("Table")->GetNumberOfTuples(), 3);
  EXPECT_EQ(AttachedTable(views, "Table", 2), (std::vector<double>{ 1, 2, 3, 4, 5, 6 }));
  ExpectError(
    [&] { AttachedTable(views, "Table", 3); }, "Table has the wrong number of columns", "2", "3");
}

TEST(ViewAccess, TooFewViewsAndBlocksThatAreNoImages)
{
  const auto views = ToBlocks(TwoPhotos());
  ExpectError([&] { ReadViews(views, {}, 3); }, "views: too few (got 2, expected at least 3)");
  ExpectError([&] { ReadViews(nullptr, {}); }, "views: too few (got 0, expected at least 1)");
  views->SetBlock(0, vtkNew<vtkPolyData>());
  ExpectError([&] { ReadViews(views, {}); }, "view 0 (p0): block is not a vtkImageData");
  views->SetBlock(0, nullptr);
  ExpectError([&] { ReadViews(views, {}); }, "block is not a vtkImageData");
}

TEST(ViewAccess, MeshesComeBackAsTheyWereWritten)
{
  const TriangleMesh mesh = SphereMesh(Vector3d(1, 2, 3), 0.1, 2);
  const TriangleMesh back = ToTriangleMesh(ToPolyData(mesh), "mesh");
  EXPECT_EQ(back.Points, mesh.Points);
  EXPECT_EQ(back.Triangles, mesh.Triangles);
}

TEST(ViewAccess, CellsThatAreNoTrianglesAreAnError)
{
  auto poly = ToPolyData(RectangleMesh(1, 1));
  const vtkIdType quad[4] = { 0, 1, 3, 2 };
  poly->GetPolys()->InsertNextCell(4, quad);
  ExpectError(
    [&] { ToTriangleMesh(poly, "mesh"); }, "mesh: a cell is not a triangle (got 4 corners");
}

TEST(ViewAccess, TriangleStripsAreNotLostInSilence)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkStripper> stripper;
  stripper->SetInputConnection(sphere->GetOutputPort());
  stripper->Update();
  ASSERT_GT(stripper->GetOutput()->GetNumberOfStrips(), 0);
  ExpectError(
    [&] { ToTriangleMesh(stripper->GetOutput(), "mesh"); }, "mesh: a cell is not a triangle");
}

TEST(ViewAccess, PointsThatAreNotFiniteAreAnError)
{
  TriangleMesh mesh = RectangleMesh(1, 1);
  mesh.Points[2].y() = std::nan("");
  ExpectError([&] { ToTriangleMesh(ToPolyData(mesh), "mesh"); }, "mesh: point 2 is not finite");
}

TEST(ViewAccess, PointFlagsDefaultToTheValueGiven)
{
  auto poly = ToPolyData(RectangleMesh(1, 1));
  EXPECT_EQ(PointFlags(poly, "Visible", 1), (std::vector<std::uint8_t>{ 1, 1, 1, 1 }));
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName("Visible");
  for (const unsigned char flag : { 0, 1, 7, 0 })
  {
    flags->InsertNextValue(flag);
  }
  poly->GetPointData()->AddArray(flags);
  EXPECT_EQ(PointFlags(poly, "Visible", 1), (std::vector<std::uint8_t>{ 0, 1, 1, 0 }));
}
