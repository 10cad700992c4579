// SPDX-License-Identifier: GPL-3.0-or-later
#include "Threads.h"
#include "support/VtkScene.h"
#include "vtkVisualHullSource.h"

#include <vtkPointData.h>

using namespace novelview;
using namespace support;

namespace
{
constexpr double Focal = 300; ///< leaves room around the object in every frame

std::vector<Camera> NineCameras()
{
  std::vector<Camera> cameras = Ring(8, 45, Focal);
  cameras.push_back(OnRing(20, 70, 4, SmallPictureK(Focal)));
  return cameras;
}

const std::vector<Photo>& SpherePhotos()
{
  static const std::vector<Photo> photos =
    TakeAll(Sphere(Vector3d::Zero(), 0.5), Plain(200, 200, 200), NineCameras());
  return photos;
}

vtkSmartPointer<vtkVisualHullSource> SourceOf(vtkMultiBlockDataSet* views)
{
  auto source = vtkSmartPointer<vtkVisualHullSource>::New();
  source->SetInputData(views);
  return source;
}
}

TEST(VisualHullSource, GivesPointsAndNormalsAndNoCells)
{
  const auto source = SourceOf(ToBlocks(SpherePhotos()));
  source->Update();
  vtkPolyData* hull = source->GetOutput();
  EXPECT_GT(hull->GetNumberOfPoints(), 1000);
  EXPECT_EQ(hull->GetNumberOfCells(), 0);
  vtkDataArray* normals = hull->GetPointData()->GetNormals();
  ASSERT_TRUE(normals);
  EXPECT_STREQ(normals->GetName(), "Normals");
  EXPECT_EQ(normals->GetNumberOfTuples(), hull->GetNumberOfPoints());
  EXPECT_EQ(source->GetNumberOfDroppedComponents(), 0);
  // Two pixels at four units from the cameras; the box's middle is off by less than a twentieth.
  EXPECT_NEAR(source->GetWorldSpacing(), 2 * 4 / Focal, 0.05 * 2 * 4 / Focal);
}

TEST(VisualHullSource, GivesTheSurfaceThroughAllSamples)
{
  const auto source = SourceOf(ToBlocks(SpherePhotos()));
  source->Update();
  vtkPolyData* surface = vtkPolyData::SafeDownCast(source->GetOutputDataObject(1));
  ASSERT_TRUE(surface);
  EXPECT_GT(surface->GetNumberOfPoints(), source->GetOutput()->GetNumberOfPoints());
  // Euler: a closed surface has twice as many triangles as points, less four for a sphere, and some
  // more or less where it is no manifold.
  EXPECT_NEAR(
    static_cast<double>(surface->GetNumberOfPolys()) / surface->GetNumberOfPoints(), 2, 0.02);
}

TEST(VisualHullSource, AWiderSpacingGivesFewerSamples)
{
  const auto source = SourceOf(ToBlocks(SpherePhotos()));
  source->Update();
  const vtkIdType fine = source->GetOutput()->GetNumberOfPoints();
  source->SetSampleSpacing(4);
  source->Update();
  // A surface: a quarter of the samples at twice the spacing, a fifth either way.
  EXPECT_NEAR(static_cast<double>(source->GetOutput()->GetNumberOfPoints()) / fine, 0.25, 0.05);
}

TEST(VisualHullSource, WhatWasDroppedIsCounted)
{
  const Shape two =
    Union({ Sphere(Vector3d(0, 0.2, 0), 0.25), Sphere(Vector3d(0, -0.3, 0), 0.15) });
  const auto source = SourceOf(ToBlocks(TakeAll(two, Plain(9, 9, 9), Ring(8, 45, Focal))));
  source->Update();
  EXPECT_EQ(source->GetNumberOfDroppedComponents(), 1);
  const vtkIdType kept = source->GetOutput()->GetNumberOfPoints();
  const vtkIdType dropped = source->GetNumberOfDroppedSamples();
  source->KeepAllComponentsOn();
  source->Update();
  EXPECT_EQ(source->GetNumberOfDroppedComponents(), 0);
  EXPECT_EQ(source->GetNumberOfDroppedSamples(), 0);
  EXPECT_EQ(source->GetOutput()->GetNumberOfPoints(), kept + dropped);
}

TEST(VisualHullSource, RunsTwiceAndOnOneOrTwoThreadsWithTheSameResult)
{
  const auto views = ToBlocks(SpherePhotos());
  const auto source = SourceOf(views);
  SetNumberOfThreads(1);
  source->Update();
  const auto first = Geometry(source->GetOutput());
  SetNumberOfThreads(2);
  source->Modified();
  source->Update();
  EXPECT_EQ(Geometry(source->GetOutput()), first);
  SetNumberOfThreads(0);
}

TEST(VisualHullSource, TheInputIsLeftAlone)
{
  const auto views = ToBlocks(SpherePhotos());
  const vtkMTimeType before = views->GetMTime();
  SourceOf(views)->Update();
  EXPECT_EQ(views->GetMTime(), before);
  EXPECT_EQ(ReadViews(views, {}).front().Mask(80, 60), SpherePhotos().front().Mask(80, 60));
}

TEST(VisualHullSource, SaysWhatIsWrong)
{
  auto photos = SpherePhotos();
  ExpectUpdateError(
    SourceOf(ToBlocks({ photos[0] })), "views: too few (got 1, expected at least 2)");
  const auto views = ToBlocks(photos);
  vtkImageData::SafeDownCast(views->GetBlock(2))->GetPointData()->RemoveArray("ContourDistance");
  ExpectUpdateError(SourceOf(views), "view 2 (p2): point array ContourDistance is missing");
  const auto source = SourceOf(ToBlocks(photos));
  source->SetSearchBounds(3, 4, 3, 4, 3, 4);
  ExpectUpdateError(source, "it is empty in the search box");
  photos[7].Mask = Image<std::uint8_t>(160, 120);
  photos[7].ContourDistance = SignedContourDistance(std::as_const(photos[7].Mask).Ref());
  ExpectUpdateError(SourceOf(ToBlocks(photos)), "view p7: the mask is empty");
}

TEST(VisualHullSource, RecoversFromAnError)
{
  const auto source = SourceOf(ToBlocks(SpherePhotos()));
  source->SetSearchBounds(3, 4, 3, 4, 3, 4);
  ExpectUpdateError(source, "it is empty in the search box");
  source->SetSearchBounds(-1, 1, -1, 1, -1, 1);
  source->Update();
  EXPECT_GT(source->GetOutput()->GetNumberOfPoints(), 1000);
}

TEST(VisualHullSource, PrintsEveryMember)
{
  ExpectPrints(vtkSmartPointer<vtkVisualHullSource>::New(),
    { "SampleSpacing", "SearchBounds", "KeepAllComponents", "NumberOfDroppedComponents",
      "NumberOfDroppedSamples", "WorldSpacing" });
}
