// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/EdgeSplitting.h"
#include "geometry/MeshTopology.h"
#include "support/Expect.h"
#include "support/Scene.h"

#include <map>
#include <random>
#include <set>

using namespace novelview;
using namespace support;

namespace
{
double AreaOf(const TriangleMesh& mesh)
{
  double area = 0;
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    const Vector3d u = mesh.Points[t[1]] - mesh.Points[t[0]];
    const Vector3d v = mesh.Points[t[2]] - mesh.Points[t[0]];
    area += 0.5 * u.cross(v).norm();
  }
  return area;
}

/** At the origin, one pixel per unit at depth 1, looking along z. */
Camera UnitCamera()
{
  Camera camera;
  camera.Width = camera.Height = 100;
  return camera;
}

/** A triangle at depth 1 whose edges from each corner to the next have the lengths 3, 4 and 5. */
TriangleMesh RightTriangle(int firstCorner)
{
  const Vector3d corners[3] = { { 0, 0, 1 }, { 3, 0, 1 }, { 3, 4, 1 } };
  TriangleMesh mesh;
  for (int k = 0; k < 3; ++k)
  {
    mesh.Points.push_back(corners[(firstCorner + k) % 3]);
  }
  mesh.Triangles.emplace_back(0, 1, 2);
  return mesh;
}
}

TEST(EdgeSplitting, CutsWhatIsLongerAndNothingElse)
{
  const std::map<double, int> cutsAt = { { 5, 0 }, { 4, 1 }, { 3, 2 }, { 2.9, 3 } };
  for (const auto& [longest, cuts] : cutsAt)
  {
    for (int first = 0; first < 3; ++first)
    {
      const TriangleMesh whole = RightTriangle(first);
      const SplitMesh split = SplitLongEdges(whole, UnitCamera(), longest);
      ASSERT_EQ(split.Ends.size(), static_cast<std::size_t>(cuts));
      ASSERT_EQ(split.Mesh.Points.size(), 3u + cuts);
      EXPECT_EQ(split.Mesh.Triangles.size(), 1u + cuts);
      EXPECT_NEAR(AreaOf(split.Mesh), 6, 1e-12);
      for (const Eigen::Vector3i& t : split.Mesh.Triangles)
      {
        const Vector3d u = split.Mesh.Points[t[1]] - split.Mesh.Points[t[0]];
        EXPECT_GT(u.cross(split.Mesh.Points[t[2]] - split.Mesh.Points[t[0]]).z(), 0)
          << "turned over";
      }
      for (int i = 0; i < cuts; ++i)
      {
        const auto [a, b] = split.Ends[i];
        EXPECT_GT((whole.Points[a] - whole.Points[b]).norm(), longest);
        EXPECT_EQ(split.Mesh.Points[3 + i], 0.5 * (whole.Points[a] + whole.Points[b]));
      }
    }
  }
}

TEST(EdgeSplitting, AClosedMeshStaysClosed)
{
  TriangleMesh whole = SphereMesh(Vector3d::Zero(), 0.5, 3);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> factor(0.7, 1.3); // edges of many lengths
  for (Vector3d& point : whole.Points)
  {
    point *= factor(random);
  }
  const Camera camera = OnRing(30);
  const double longest = 8;
  const SplitMesh split = SplitLongEdges(whole, camera, longest);
  std::set<std::size_t> kinds;
  for (const Eigen::Vector3i& t : whole.Triangles)
  {
    std::size_t cuts = 0;
    for (int k = 0; k < 3; ++k)
    {
      const Vector3d& a = whole.Points[t[k]];
      const Vector3d& b = whole.Points[t[(k + 1) % 3]];
      cuts += (camera.Project(a) - camera.Project(b)).norm() > longest;
    }
    kinds.insert(cuts);
  }
  ASSERT_EQ(kinds.size(), 4u) << "the case is to have triangles of every kind";
  EXPECT_TRUE(ExamineTopology(split.Mesh).IsClosedAndOriented());
  EXPECT_TRUE(ExamineTopology(split.Mesh).IsManifold());
  EXPECT_NEAR(AreaOf(split.Mesh), AreaOf(whole), 1e-9);
  for (const Eigen::Vector3i& t : split.Mesh.Triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int a = t[k];
      const int b = t[(k + 1) % 3];
      const bool old = std::max(a, b) < static_cast<int>(whole.Points.size());
      EXPECT_FALSE(old &&
        (camera.Project(whole.Points[a]) - camera.Project(whole.Points[b])).norm() > longest);
    }
  }
}

TEST(EdgeSplitting, EdgesThatReachBehindTheCameraStayWhole)
{
  TriangleMesh mesh = RightTriangle(0);
  mesh.Points[0].z() = -1;
  const SplitMesh split = SplitLongEdges(mesh, UnitCamera(), 1);
  ASSERT_EQ(split.Ends.size(), 1u);
  EXPECT_EQ(split.Ends[0], (std::array<int, 2>{ 1, 2 }));
}
