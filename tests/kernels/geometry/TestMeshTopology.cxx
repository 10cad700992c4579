// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/Error.h"
#include "geometry/MeshTopology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace novelview;
using Eigen::Vector3d;
using Eigen::Vector3i;

namespace
{
TriangleMesh Tetrahedron()
{
  TriangleMesh mesh;
  mesh.Points = { Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1) };
  mesh.Triangles = { Vector3i(0, 2, 1), Vector3i(0, 1, 3), Vector3i(0, 3, 2), Vector3i(1, 2, 3) };
  return mesh;
}

/** Two tetrahedra with `shared` common points. */
TriangleMesh TwoTetrahedra(int shared)
{
  TriangleMesh mesh = Tetrahedron();
  std::vector<int> ids;
  for (int i = 0; i < 4; ++i)
  {
    ids.push_back(i < shared ? i : static_cast<int>(mesh.Points.size()));
    if (i >= shared)
    {
      mesh.Points.push_back(Vector3d(-1, -1, -1) * i);
    }
  }
  for (const Vector3i& t : Tetrahedron().Triangles)
  {
    mesh.Triangles.emplace_back(ids[t[0]], ids[t[1]], ids[t[2]]);
  }
  return mesh;
}
}

TEST(MeshTopology, OfATetrahedron)
{
  const MeshTopology topology = ExamineTopology(Tetrahedron());
  EXPECT_TRUE(topology.IsClosedAndOriented());
  EXPECT_TRUE(topology.IsManifold());
  EXPECT_EQ(topology.EulerCharacteristic(), 2);
  EXPECT_EQ(topology.Components, 1);
  EXPECT_EQ(topology.Genus(), 0);
  EXPECT_EQ(topology.UnusedPoints, 0);
  EXPECT_DOUBLE_EQ(SignedVolume(Tetrahedron()), 1.0 / 6);
}

TEST(MeshTopology, OfATorus)
{
  TriangleMesh mesh;
  const int n = 5;
  mesh.Points.resize(n * n, Vector3d::Zero());
  auto id = [](int i, int j) { return (i % n) * n + j % n; };
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      mesh.Triangles.emplace_back(id(i, j), id(i + 1, j), id(i + 1, j + 1));
      mesh.Triangles.emplace_back(id(i, j), id(i + 1, j + 1), id(i, j + 1));
    }
  }
  const MeshTopology topology = ExamineTopology(mesh);
  EXPECT_TRUE(topology.IsClosedAndOriented());
  EXPECT_TRUE(topology.IsManifold());
  EXPECT_EQ(topology.EulerCharacteristic(), 0);
  EXPECT_EQ(topology.Genus(), 1);
}

TEST(MeshTopology, FindsAHole)
{
  TriangleMesh mesh = Tetrahedron();
  mesh.Triangles.pop_back();
  const MeshTopology topology = ExamineTopology(mesh);
  EXPECT_EQ(topology.BorderEdges, 3);
  EXPECT_FALSE(topology.IsClosedAndOriented());
  EXPECT_TRUE(topology.IsManifold());
}

TEST(MeshTopology, FindsATurnedTriangle)
{
  TriangleMesh mesh = Tetrahedron();
  std::swap(mesh.Triangles[0][0], mesh.Triangles[0][1]);
  const MeshTopology topology = ExamineTopology(mesh);
  EXPECT_EQ(topology.MisorientedEdges, 3);
  EXPECT_FALSE(topology.IsClosedAndOriented());
  EXPECT_TRUE(topology.IsManifold());
}

TEST(MeshTopology, FindsSharedPointsAndEdges)
{
  const MeshTopology apart = ExamineTopology(TwoTetrahedra(0));
  EXPECT_EQ(apart.Components, 2);
  EXPECT_EQ(apart.Genus(), 0);
  EXPECT_TRUE(apart.IsManifold());
  const MeshTopology atAPoint = ExamineTopology(TwoTetrahedra(1));
  EXPECT_EQ(atAPoint.NonManifoldPoints, 1);
  EXPECT_EQ(atAPoint.NonManifoldEdges, 0);
  EXPECT_EQ(atAPoint.Components, 1);
  const MeshTopology atAnEdge = ExamineTopology(TwoTetrahedra(2));
  EXPECT_EQ(atAnEdge.NonManifoldEdges, 1);
}

TEST(MeshTopology, CountsUnusedPointsAndDegenerateTriangles)
{
  TriangleMesh mesh = Tetrahedron();
  mesh.Points.push_back(Vector3d(5, 5, 5));
  mesh.Triangles.emplace_back(0, 0, 1);
  const MeshTopology topology = ExamineTopology(mesh);
  EXPECT_EQ(topology.UnusedPoints, 1);
  EXPECT_EQ(topology.DegenerateTriangles, 1);
  EXPECT_FALSE(topology.IsManifold());
}

TEST(KeepLargestComponent, DropsTheSmallerOneAndPointsOfNone)
{
  TriangleMesh mesh = TwoTetrahedra(0);
  mesh.Points.insert(mesh.Points.begin(), Vector3d(9, 9, 9)); // used by none
  for (Eigen::Vector3i& t : mesh.Triangles)
  {
    t += Eigen::Vector3i::Ones();
  }
  mesh.Triangles.erase(mesh.Triangles.begin()); // the first one is smaller now
  const Vector3d corner = mesh.Points[mesh.Triangles.back()[0]];
  const DroppedComponents dropped = KeepLargestComponent(mesh);
  EXPECT_EQ(dropped.Components, 1);
  EXPECT_EQ(dropped.Triangles, 3);
  ASSERT_EQ(mesh.Points.size(), 4);
  ASSERT_EQ(mesh.Triangles.size(), 4);
  EXPECT_EQ(mesh.Points[mesh.Triangles.back()[0]], corner);
  EXPECT_TRUE(ExamineTopology(mesh).IsClosedAndOriented());
}

TEST(KeepLargestComponent, LeavesAnEmptyMeshAlone)
{
  TriangleMesh mesh;
  EXPECT_EQ(KeepLargestComponent(mesh).Components, 0);
  EXPECT_TRUE(mesh.Triangles.empty());
}

TEST(MeshTopology, RefusesIdsThatDoNotExist)
{
  TriangleMesh mesh = Tetrahedron();
  mesh.Triangles[2][1] = 4;
  try
  {
    ExamineTopology(mesh);
    FAIL() << "no error";
  }
  catch (const Error& error)
  {
    EXPECT_THAT(error.what(), testing::HasSubstr("triangle 2 names a point that does not exist"));
  }
}
