// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/Visibility.h"
#include "support/Expect.h"
#include "support/Scene.h"

#include <Eigen/Dense>

#include <fstream>
#include <numeric>
#include <sstream>

using namespace novelview;
using namespace support;

namespace
{
enum class Verdict
{
  Free,
  Hidden,
  Doubtful
};

/**
 * The paper's definition in its own words, independent of the product's: the vertex, seen from the
 * centre, is a combination of the triangle's corners with weights >= 0 (it is in the cone) that sum
 * to more than one (it is behind the triangle).
 */
Verdict InConeBehind(
  const TriangleMesh& mesh, const Vector3d& centre, const Eigen::Vector3i& t, int pointId)
{
  if ((t.array() == pointId).any())
  {
    return Verdict::Free;
  }
  Eigen::Matrix3d corners;
  corners << mesh.Points[t[0]] - centre, mesh.Points[t[1]] - centre, mesh.Points[t[2]] - centre;
  const Vector3d weights = corners.fullPivLu().solve(mesh.Points[pointId] - centre);
  const double scale = weights.cwiseAbs().maxCoeff();
  // A vertex on the cone's boundary may go either way: the definition does not decide it.
  if (weights.minCoeff() > 1e-7 * scale && weights.sum() > 1 + 1e-5)
  {
    return Verdict::Hidden;
  }
  return weights.minCoeff() < -1e-7 * scale || weights.sum() < 1 - 1e-5 ? Verdict::Free
                                                                        : Verdict::Doubtful;
}

/** Compares with the definition over all triangles, for the given vertices; counts agreements. */
int CompareWithDefinition(
  const TriangleMesh& mesh, const Camera& camera, const std::vector<int>& pointIds)
{
  const std::vector<std::uint8_t> visible = VisibleVertices(mesh, camera);
  const Vector3d centre = camera.Centre();
  const double tolerance = 1e-6 * BoundingDiagonal(mesh.Points);
  int compared = 0;
  for (const int pointId : pointIds)
  {
    bool hidden = false;
    bool doubtful = false;
    bool hiddenByKernel = false;
    for (std::size_t cellId = 0; cellId < mesh.Triangles.size(); ++cellId)
    {
      const Verdict verdict = InConeBehind(mesh, centre, mesh.Triangles[cellId], pointId);
      hidden = hidden || verdict == Verdict::Hidden;
      doubtful = doubtful || verdict == Verdict::Doubtful;
      hiddenByKernel =
        hiddenByKernel || HidesVertex(mesh, camera, static_cast<int>(cellId), pointId, tolerance);
    }
    EXPECT_EQ(visible[pointId], !hiddenByKernel) << "vertex " << pointId;
    if (hidden || !doubtful)
    {
      ++compared;
      EXPECT_EQ(visible[pointId], !hidden) << "vertex " << pointId;
    }
  }
  return compared;
}

std::vector<int> SomePoints(const TriangleMesh& mesh, int count, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> pick(0, static_cast<int>(mesh.Points.size()) - 1);
  std::vector<int> ids(count);
  for (int& id : ids)
  {
    id = pick(random);
  }
  return ids;
}

/** Vertices and faces of an OBJ file. */
TriangleMesh ReadObj(std::istream& file)
{
  TriangleMesh mesh;
  std::string line;
  while (std::getline(file, line))
  {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v")
    {
      Vector3d p;
      words >> p.x() >> p.y() >> p.z();
      mesh.Points.push_back(p);
    }
    else if (kind == "f")
    {
      Eigen::Vector3i t;
      for (int corner = 0; corner < 3; ++corner)
      {
        std::string word;
        words >> word;
        t[corner] = std::stoi(word) - 1;
      }
      mesh.Triangles.push_back(t);
    }
  }
  return mesh;
}
}

TEST(Visibility, EqualsTheConeDefinitionOnTriangleSoups)
{
  for (unsigned seed = 1; seed <= 5; ++seed)
  {
    for (const double size : { 0.1, 0.8 })
    {
      const TriangleMesh mesh = TriangleSoup(120, size, seed);
      std::vector<int> all(mesh.Points.size());
      std::iota(all.begin(), all.end(), 0);
      // Nothing is degenerate in a soup: all but a handful must be decided.
      EXPECT_GT(CompareWithDefinition(mesh, OnRing(40.0 * seed, 20), all), 355);
    }
  }
}

TEST(Visibility, EqualsTheConeDefinitionOnTheBunny)
{
  std::ifstream file("/usr/share/glmark2/models/bunny.obj");
  if (!file)
  {
    GTEST_SKIP() << "the package glmark2-data is not installed";
  }
  const TriangleMesh mesh = ReadObj(file);
  ASSERT_GT(mesh.Triangles.size(), 60000u);
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : mesh.Points)
  {
    box.extend(point);
  }
  const double distance = 2 * box.diagonal().norm();
  const Camera camera = LookAt(box.center() + distance * Vector3d(0.6, 0.3, 0.74).normalized(),
    box.center(), Vector3d::UnitY(), SmallPictureK(), 160, 120);
  EXPECT_GT(CompareWithDefinition(mesh, camera, SomePoints(mesh, 60, 9)), 50);
}

TEST(Visibility, OfASphereTheFacingSideIsSeen)
{
  const TriangleMesh mesh = SphereMesh(Vector3d(0.1, 0.2, 0.3), 0.5, 4);
  const Camera camera = OnRing(130, 30);
  const auto visible = VisibleVertices(mesh, camera);
  for (std::size_t ptId = 0; ptId < mesh.Points.size(); ++ptId)
  {
    const Vector3d normal = (mesh.Points[ptId] - Vector3d(0.1, 0.2, 0.3)).normalized();
    const double cosine = normal.dot((camera.Centre() - mesh.Points[ptId]).normalized());
    // Near the boundary the facets, 0.1 radians wide, decide instead of the sphere.
    if (std::abs(cosine) > 0.12)
    {
      EXPECT_EQ(visible[ptId], cosine > 0);
    }
  }
}

TEST(Visibility, VerticesBehindTheCameraAreInvisibleAndHideNothing)
{
  TriangleMesh mesh = RectangleMesh(0.5, 0.5, 0); // points 0 to 3
  mesh.Points.emplace_back(0.1, 0.2, -1);
  mesh.Points.emplace_back(0, 0, 6); // behind the camera at z = 4
  const Camera camera = OnRing(0);
  EXPECT_EQ(VisibleVertices(mesh, camera), (std::vector<std::uint8_t>{ 1, 1, 1, 1, 0, 0 }));
  mesh.Points[0].z() = mesh.Points[2].z() = 5; // now both triangles reach behind it
  EXPECT_EQ(VisibleVertices(mesh, camera)[4], 1);
}

TEST(Visibility, TheToleranceIsAShareOfTheDiagonal)
{
  TriangleMesh mesh = RectangleMesh(0.5, 0.5, 0);
  mesh.Points.emplace_back(0.1, 0.2, -0.01); // the diagonal is sqrt(2)
  EXPECT_EQ(VisibleVertices(mesh, OnRing(0), 0.006)[4], 0);
  EXPECT_EQ(VisibleVertices(mesh, OnRing(0), 0.008)[4], 1);
}

TEST(Visibility, SameBitsWithOneAndMoreThreads)
{
  const TriangleMesh mesh = TriangleSoup(500, 0.3, 11);
  EXPECT_EQ(VisibleVertices(mesh, OnRing(0)), VisibleVertices(mesh, OnRing(0), 1e-6, InThreads(3)));
}

TEST(Visibility, AnEmptyMeshHasNoVisibleVertices)
{
  EXPECT_TRUE(VisibleVertices({}, OnRing(0)).empty());
  EXPECT_EQ(BoundingDiagonal({}), 0);
}

TEST(Visibility, InsideIsByTheWindingNumber)
{
  TriangleMesh mesh = SphereMesh(Vector3d(1, 0, 0), 0.5, 3);
  EXPECT_TRUE(IsInside(mesh, Vector3d(1.3, 0.1, 0)));
  EXPECT_FALSE(IsInside(mesh, Vector3d(0.4, 0, 0)));
  EXPECT_FALSE(IsInside(mesh, Vector3d(9, 9, 9)));
  for (Eigen::Vector3i& t : mesh.Triangles)
  {
    std::swap(t[0], t[1]);
  }
  EXPECT_TRUE(IsInside(mesh, Vector3d(1.3, 0.1, 0)))
    << "turned inside out it is closed all the same";
}
