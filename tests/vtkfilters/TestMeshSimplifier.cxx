// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/MeshSimplification.h"
#include "support/VtkScene.h"
#include "vtkMeshSimplifier.h"

using namespace novelview;
using namespace support;

namespace
{
vtkSmartPointer<vtkMeshSimplifier> SimplifierOf(const TriangleMesh& mesh)
{
  auto simplifier = vtkSmartPointer<vtkMeshSimplifier>::New();
  simplifier->SetInputData(ToPolyData(mesh));
  return simplifier;
}

const TriangleMesh Ball = SphereMesh(Vector3d::Zero(), 0.5, 3);
}

TEST(MeshSimplifier, LeavesWhatTheKernelLeavesAndMeasuresIt)
{
  const auto simplifier = SimplifierOf(Ball);
  simplifier->SetNumberOfTriangles(200);
  simplifier->Update();
  const SimplifiedMesh expected = SimplifyMesh(Ball, 200);
  EXPECT_EQ(Geometry(simplifier->GetOutput()).first, expected.Mesh.Points);
  EXPECT_EQ(Geometry(simplifier->GetOutput()).second, expected.Mesh.Triangles);
  EXPECT_EQ(simplifier->GetMaximumDistance(), expected.MaxDistance);
  EXPECT_GT(expected.MaxDistance, 0);
  EXPECT_EQ(simplifier->GetGenus(), 0);
  EXPECT_EQ(simplifier->GetNumberOfSelfIntersections(), 0);
}

TEST(MeshSimplifier, WithoutANumberTheMeshIsOnlyExamined)
{
  TriangleMesh mesh = Ball;
  mesh.Points[0] *= -1.5; // through the other side
  const auto simplifier = SimplifierOf(mesh);
  simplifier->Update();
  EXPECT_EQ(Geometry(simplifier->GetOutput()).first, mesh.Points);
  EXPECT_EQ(Geometry(simplifier->GetOutput()).second, mesh.Triangles);
  EXPECT_EQ(simplifier->GetMaximumDistance(), 0);
  EXPECT_GT(simplifier->GetNumberOfSelfIntersections(), 0);
}

TEST(MeshSimplifier, SaysWhatIsWrong)
{
  TriangleMesh fan;
  fan.Points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, -1, 0 } };
  fan.Triangles = { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } };
  ExpectUpdateError(SimplifierOf(fan), "mesh: it is not a manifold");
}

TEST(MeshSimplifier, PrintsEveryMember)
{
  ExpectPrints(SimplifierOf(Ball),
    { "NumberOfTriangles", "MaximumDistance", "NumberOfSelfIntersections", "Genus" });
}
