// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/NovelProjection.h"
#include "geometry/Visibility.h"
#include "support/VtkScene.h"
#include "vtkVisibilityCuller.h"

#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkPointData.h>

#include <set>

using namespace novelview;
using namespace support;

namespace
{
vtkSmartPointer<vtkVisibilityCuller> CullerOf(const TriangleMesh& mesh, const Camera& camera)
{
  auto culler = vtkSmartPointer<vtkVisibilityCuller>::New();
  culler->SetInputData(ToPolyData(mesh));
  culler->SetCamera(NewPinholeCamera(camera));
  return culler;
}

/** Corners of each triangle as a set of nine numbers, to find triangles again. */
std::multiset<std::vector<double>> Corners(
  const std::vector<Vector3d>& points, const std::vector<Eigen::Vector3i>& triangles)
{
  std::multiset<std::vector<double>> result;
  for (const Eigen::Vector3i& t : triangles)
  {
    std::vector<double> corners;
    for (int corner = 0; corner < 3; ++corner)
    {
      const Vector3d& p = points[t[corner]];
      corners.insert(corners.end(), p.data(), p.data() + 3);
    }
    result.insert(corners);
  }
  return result;
}
}

TEST(VisibilityCuller, RemovesATriangleOnlyIfAllItsCornersAreInvisible)
{
  const TriangleMesh mesh = TriangleSoup(150, 0.5, 4);
  const auto visible = VisibleVertices(mesh, OnRing(10));
  const auto culler = CullerOf(mesh, OnRing(10));
  culler->Update();
  const NovelProjection projection(mesh, OnRing(10));
  std::vector<Eigen::Vector3i> kept;
  std::vector<Eigen::Vector3i> occluders; // what is removed, and what faces away
  std::size_t removed = 0;
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    const bool isKept = visible[t[0]] || visible[t[1]] || visible[t[2]];
    removed += !isKept;
    if (isKept)
    {
      kept.push_back(t);
    }
    if (!isKept || !projection.Faces(t))
    {
      occluders.push_back(t);
    }
  }
  ASSERT_GT(removed, 0u);
  ASSERT_GT(occluders.size(), removed);
  const auto [keptPoints, keptTriangles] = Geometry(culler->GetOutput(0));
  const auto [removedPoints, removedTriangles] = Geometry(culler->GetOutput(1));
  EXPECT_EQ(Corners(keptPoints, keptTriangles), Corners(mesh.Points, kept));
  EXPECT_EQ(Corners(removedPoints, removedTriangles), Corners(mesh.Points, occluders));
}

TEST(VisibilityCuller, PointDataPassThroughAndPointsKnowWhereTheyCameFrom)
{
  const TriangleMesh mesh = SphereMesh(Vector3d::Zero(), 0.5, 3);
  const auto input = ToPolyData(mesh);
  vtkNew<vtkIdTypeArray> own;
  own->SetName("Own");
  for (std::size_t ptId = 0; ptId < mesh.Points.size(); ++ptId)
  {
    own->InsertNextValue(static_cast<vtkIdType>(1000 + ptId));
  }
  input->GetPointData()->AddArray(own);
  const auto culler = CullerOf(mesh, OnRing(10));
  culler->SetInputData(input);
  culler->Update();
  vtkPointData* data = culler->GetOutput(0)->GetPointData();
  vtkDataArray* ids = data->GetArray("OriginalPointIds");
  vtkDataArray* visible = data->GetArray("Visible");
  ASSERT_TRUE(ids && visible && data->GetArray("Own"));
  const auto expected = VisibleVertices(mesh, OnRing(10));
  const auto points = Geometry(culler->GetOutput(0)).first;
  for (vtkIdType ptId = 0; ptId < culler->GetOutput(0)->GetNumberOfPoints(); ++ptId)
  {
    const auto id = static_cast<std::size_t>(ids->GetComponent(ptId, 0));
    EXPECT_EQ(points[ptId], mesh.Points[id]);
    EXPECT_EQ(visible->GetComponent(ptId, 0), expected[id]);
    EXPECT_EQ(data->GetArray("Own")->GetComponent(ptId, 0), 1000.0 + id);
  }
  EXPECT_EQ(input->GetPointData()->GetNumberOfArrays(), 1) << "the input is left alone";
}

TEST(VisibilityCuller, WhatRemainsIsMadeAsFineAsAsked)
{
  const TriangleMesh mesh = SphereMesh(Vector3d::Zero(), 0.5, 3);
  const auto input = ToPolyData(mesh);
  vtkNew<vtkDoubleArray> own;
  own->SetName("Own");
  for (const Vector3d& point : mesh.Points)
  {
    own->InsertNextValue(point.x());
  }
  input->GetPointData()->AddArray(own);
  const auto culler = CullerOf(mesh, OnRing(10));
  culler->SetInputData(input);
  culler->Update();
  const auto whole = Geometry(culler->GetOutput());
  const auto removed = Geometry(culler->GetOutput(1));
  culler->SetMaximumEdgeLength(4);
  culler->Update();
  const auto fine = Geometry(culler->GetOutput());
  EXPECT_GT(fine.second.size(), 2 * whole.second.size());
  EXPECT_EQ(Geometry(culler->GetOutput(1)), removed);
  vtkPointData* data = culler->GetOutput()->GetPointData();
  for (std::size_t ptId = 0; ptId < fine.first.size(); ++ptId)
  {
    const auto id = static_cast<vtkIdType>(ptId);
    EXPECT_EQ(
      data->GetArray("OriginalPointIds")->GetComponent(id, 0) < 0, ptId >= whole.first.size());
    EXPECT_NEAR(data->GetArray("Own")->GetComponent(id, 0), fine.first[ptId].x(), 1e-12)
      << "the middle has the mean of its ends";
  }
  EXPECT_EQ(
    data->GetArray("Visible")->GetNumberOfTuples(), static_cast<vtkIdType>(fine.first.size()));
}

TEST(VisibilityCuller, FollowsItsCameraAndRunsTwice)
{
  const TriangleMesh mesh = SphereMesh(Vector3d::Zero(), 0.5, 3);
  const auto culler = CullerOf(mesh, OnRing(0));
  culler->Update();
  const auto first = Geometry(culler->GetOutput());
  const vtkMTimeType before = culler->GetMTime();
  FromCamera(OnRing(90), culler->GetCamera());
  EXPECT_GT(culler->GetMTime(), before);
  culler->Update();
  EXPECT_NE(Geometry(culler->GetOutput()).first, first.first);
  FromCamera(OnRing(0), culler->GetCamera());
  culler->Update();
  EXPECT_EQ(Geometry(culler->GetOutput()), first);
}

TEST(VisibilityCuller, SaysWhatIsWrongWithTheCamera)
{
  const TriangleMesh mesh = SphereMesh(Vector3d::Zero(), 0.5, 3);
  const auto culler = CullerOf(mesh, OnRing(0));
  culler->SetCamera(nullptr);
  ExpectUpdateError(culler, "novel camera: none is set");
  ExpectUpdateError(CullerOf(mesh, OnRing(0, 0, 0.2)), "novel camera: it is inside the object");
  const Camera away =
    LookAt(Vector3d(0, 0, 4), Vector3d(0, 0, 9), Vector3d::UnitY(), SmallPictureK(), 160, 120);
  ExpectUpdateError(CullerOf(mesh, away),
    "novel camera: no part of the object is in its frame: it faces away from the object");
  Camera singular = OnRing(0);
  singular.K(1, 1) = 0;
  ExpectUpdateError(CullerOf(mesh, singular), "novel camera: camera matrix K is singular");
  Camera noSize = OnRing(0);
  noSize.Height = 0;
  ExpectUpdateError(CullerOf(mesh, noSize), "novel camera: image size is not positive");
}

TEST(VisibilityCuller, ACloseUpBetweenVerticesDoesNotLookAway)
{
  // Two large triangles fill the frame; their corners are all outside it.
  const auto culler = CullerOf(RectangleMesh(5, 5), OnRing(0));
  culler->Update();
  EXPECT_EQ(culler->GetOutput()->GetNumberOfCells(), 2);
}

TEST(VisibilityCuller, AnEmptyMeshIsNoError)
{
  const auto culler = CullerOf({}, OnRing(0));
  culler->Update();
  EXPECT_EQ(culler->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(VisibilityCuller, PrintsEveryMember)
{
  ExpectPrints(
    CullerOf({}, OnRing(0)), { "Camera", "CameraMatrix", "Tolerance", "MaximumEdgeLength" });
  EXPECT_THAT(
    Printed(vtkSmartPointer<vtkVisibilityCuller>::New()), testing::HasSubstr("Camera: (none)"));
}
