// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/MeshSimplification.h"

#include "geometry/MeshTopology.h"
#include "support/Expect.h"
#include "support/Scene.h"

using namespace novelview;
using namespace support;

namespace
{
/** A torus of around x across squares, cut into triangles. */
TriangleMesh TorusMesh(int around, int across)
{
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i)
  {
    for (int j = 0; j < across; ++j)
    {
      const double a = 2 * EIGEN_PI * i / around;
      const double b = 2 * EIGEN_PI * j / across;
      const double r = 1 + 0.3 * std::cos(b);
      mesh.Points.emplace_back(r * std::cos(a), r * std::sin(a), 0.3 * std::sin(b));
      const auto at = [&](int m, int n) { return (i + m) % around * across + (j + n) % across; };
      mesh.Triangles.emplace_back(at(0, 0), at(1, 0), at(1, 1));
      mesh.Triangles.emplace_back(at(0, 0), at(1, 1), at(0, 1));
    }
  }
  return mesh;
}
}

TEST(MeshSimplification, LeavesTheNumberOfTrianglesAndTheHandle)
{
  const TriangleMesh torus = TorusMesh(80, 40);
  const SimplifiedMesh simple = SimplifyMesh(torus, 800);
  EXPECT_LE(simple.Mesh.Triangles.size(), 800U);
  EXPECT_GT(simple.Mesh.Triangles.size(), 790U);
  const MeshTopology topology = ExamineTopology(simple.Mesh);
  EXPECT_TRUE(topology.IsClosedAndOriented());
  EXPECT_TRUE(topology.IsManifold());
  EXPECT_EQ(topology.Genus(), 1);
  EXPECT_EQ(topology.UnusedPoints, 0);
  // 800 triangles have edges of about 0.18: chords of the tube with a height of 0.014.
  EXPECT_GT(simple.MaxDistance, 0);
  EXPECT_LT(simple.MaxDistance, 0.03);
  EXPECT_NEAR(SignedVolume(simple.Mesh), SignedVolume(torus), 0.02 * SignedVolume(torus));
}

TEST(MeshSimplification, FewEnoughTrianglesStay)
{
  const TriangleMesh torus = TorusMesh(12, 8);
  const SimplifiedMesh same = SimplifyMesh(torus, 1000);
  EXPECT_EQ(same.Mesh.Points, torus.Points);
  EXPECT_EQ(same.Mesh.Triangles.size(), torus.Triangles.size());
  EXPECT_NEAR(same.MaxDistance, 0, 1e-9);
}

TEST(MeshSimplification, CountsPairsThatIntersect)
{
  TriangleMesh mesh = SphereMesh(Vector3d::Zero(), 0.5, 2);
  EXPECT_EQ(CountSelfIntersections(mesh), 0U);
  mesh.Points[0] *= -1.5; // through the other side
  EXPECT_GT(CountSelfIntersections(mesh), 0U);
}

TEST(MeshSimplification, AMeshThatIsNoManifoldIsAnError)
{
  TriangleMesh fan;
  fan.Points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, -1, 0 } };
  fan.Triangles = { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } };
  ExpectError([&] { SimplifyMesh(fan, 1); }, "mesh: it is not a manifold");
}
