// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion/FusedSurface.h"

#include "geometry/MeshTopology.h"
#include "support/Expect.h"
#include "support/Scene.h"

#include <algorithm>
#include <limits>

using namespace novelview;
using namespace support;

namespace
{
/** Photographs of a shape with its true depth maps, all sure. */
struct SceneOfMaps
{
  SceneOfMaps(const Shape& shape, const std::vector<Camera>& cameras)
    : Photos(TakeAll(shape, Plain(200, 200, 200), cameras))
    , Sure(160, 120, 1, 1.f)
  {
  }
  std::vector<View> Views() const
  {
    std::vector<View> views = ViewsOf(this->Photos);
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      views[i].DepthMap = this->Photos[i].TrueDepth.Ref();
      views[i].Confidence = this->Sure.Ref();
    }
    return views;
  }
  std::vector<Photo> Photos;
  Image<float> Sure;
};

SceneOfMaps BallScene()
{
  return { Sphere(Vector3d::Zero(), 0.5), Ring(8, 45) };
}

void ExpectClosedManifold(const TriangleMesh& mesh, int genus)
{
  const MeshTopology topology = ExamineTopology(mesh);
  EXPECT_TRUE(topology.IsClosedAndOriented());
  EXPECT_TRUE(topology.IsManifold());
  EXPECT_EQ(topology.UnusedPoints, 0);
  EXPECT_EQ(topology.Components, 1);
  EXPECT_EQ(topology.Genus(), genus);
  EXPECT_GT(SignedVolume(mesh), 0) << "outwards";
}

const std::vector<Vector3d> LargeHull = SphereMesh(Vector3d::Zero(), 0.55, 4).Points;
}

TEST(FusedSurface, BallFromAHullThatIsTooLarge)
{
  const SceneOfMaps ball = BallScene();
  const TriangleMesh mesh = FuseDepthMaps(LargeHull, ball.Views()).Mesh;
  ExpectClosedManifold(mesh, 0);
  double worst = 0;
  for (const Vector3d& point : mesh.Points)
  {
    // Nearer the poles the cameras of the ring graze the surface.
    worst = std::abs(point.y()) < 0.3 ? std::max(worst, std::abs(point.norm() - 0.5)) : worst;
  }
  // A pixel is 0.009 at the surface; the map is read at its nearest pixel.
  EXPECT_LT(worst, 0.009);
}

TEST(FusedSurface, TorusHasAHandle)
{
  std::vector<Camera> cameras;
  for (int i = 0; i < 12; ++i)
  {
    cameras.push_back(OnRing(30 * i, i % 2 ? 50 : -50));
  }
  const DistanceFunction torus = TorusDistance(0.4, 0.15);
  const SceneOfMaps scene(Traced(torus, 0.6), cameras);
  // The hull that is given has none: only its points count.
  const TriangleMesh mesh = FuseDepthMaps(LargeHull, scene.Views()).Mesh;
  ExpectClosedManifold(mesh, 1);
  double sum = 0;
  for (const Vector3d& point : mesh.Points)
  {
    sum += std::abs(torus(point));
  }
  EXPECT_LT(sum / mesh.Points.size(), 0.0045) << "half a pixel";
}

TEST(FusedSurface, HullStaysWhereNoPhotographSees)
{
  SceneOfMaps ball = BallScene();
  for (Photo& photo : ball.Photos)
  {
    std::fill(photo.TrueDepth.Values.begin(), photo.TrueDepth.Values.end(), 0.f);
  }
  const std::vector<View> views = ball.Views();
  const TriangleMesh mesh = FuseDepthMaps(LargeHull, views).Mesh;
  ExpectClosedManifold(mesh, 0);
  for (const Vector3d& point : mesh.Points)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (const View& view : views)
    {
      const Vector2d pixel = view.Cam.Project(point);
      nearest = std::min(nearest, SampleBilinear(view.ContourDistance, pixel.x(), pixel.y()));
    }
    // Inside the hull by less than the spacing of 1.25 pixels; creases are cut by a little more.
    EXPECT_GT(nearest, -0.25);
    EXPECT_LT(nearest, 2);
  }
}

TEST(FusedSurface, KeepsTheLargestComponentAndTellsWhatItDropped)
{
  const SceneOfMaps scene(
    Union({ Sphere(Vector3d(0, -0.1, 0), 0.3), Sphere(Vector3d(0, 0.4, 0), 0.1) }), Ring(8, 45));
  const FusedSurface largest = FuseDepthMaps(LargeHull, scene.Views());
  ExpectClosedManifold(largest.Mesh, 0);
  EXPECT_EQ(largest.Dropped.Components, 1);
  FusedSurfaceOptions options;
  options.KeepAllComponents = true;
  const FusedSurface all = FuseDepthMaps(LargeHull, scene.Views(), options);
  EXPECT_EQ(ExamineTopology(all.Mesh).Components, 2);
  EXPECT_EQ(all.Dropped.Components, 0);
  EXPECT_EQ(all.Mesh.Triangles.size(), largest.Mesh.Triangles.size() + largest.Dropped.Triangles);
}

TEST(FusedSurface, AnotherSplitOfTheLoopsGivesTheSameBits)
{
  const SceneOfMaps ball = BallScene();
  Execution backwards;
  backwards.ParallelFor = [](std::int64_t count, const Execution::RangeBody& body)
  {
    for (std::int64_t i = count; i-- > 0;)
    {
      body(i, i + 1);
    }
  };
  const TriangleMesh one = FuseDepthMaps(LargeHull, ball.Views()).Mesh;
  const TriangleMesh other = FuseDepthMaps(LargeHull, ball.Views(), {}, backwards).Mesh;
  EXPECT_EQ(one.Points, other.Points);
  EXPECT_EQ(one.Triangles, other.Triangles);
}

TEST(FusedSurface, BadInputIsNamed)
{
  const SceneOfMaps ball = BallScene();
  ExpectError([&] { FuseDepthMaps(LargeHull, ViewsOf(ball.Photos)); },
    "view p0: point array Depth or Confidence is missing");
  ExpectError([&] { FuseDepthMaps({}, ball.Views()); },
    "depth map fusion: the hull has no points or lies behind every camera");
  SceneOfMaps empty = BallScene();
  for (Photo& photo : empty.Photos)
  {
    std::fill(photo.TrueDepth.Values.begin(), photo.TrueDepth.Values.end(), 100.f);
  }
  ExpectError([&] { FuseDepthMaps(LargeHull, empty.Views()); },
    "depth map fusion: the depth maps leave nothing of the object");
}
