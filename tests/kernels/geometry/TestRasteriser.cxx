// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/DepthImage.h"
#include "geometry/Rasteriser.h"
#include "support/Expect.h"
#include "support/Scene.h"

#include <Eigen/Dense>

using namespace novelview;
using namespace support;

namespace
{
Camera SkewedCamera()
{
  Eigen::Matrix3d k;
  k << 70, 3, 30, 0, 80, 25, 0, 0, 1;
  return OnRing(25, 15, 4, k, 64, 48);
}

/** Depths at which a pixel's ray meets the triangles, and whether an edge is too near to tell. */
struct RayHits
{
  std::vector<std::pair<double, int>> Hits;
  bool Doubtful = false;
};

RayHits CastRay(const TriangleMesh& mesh, const Camera& camera, int x, int y)
{
  RayHits result;
  const Vector3d centre = camera.Centre();
  const Vector3d direction = camera.Unproject(Vector2d(x, y), 1) - centre;
  for (std::size_t cellId = 0; cellId < mesh.Triangles.size(); ++cellId)
  {
    const Eigen::Vector3i& t = mesh.Triangles[cellId];
    Eigen::Matrix3d corners;
    corners << mesh.Points[t[0]] - centre, mesh.Points[t[1]] - centre, mesh.Points[t[2]] - centre;
    // direction = corners * weights: the ray meets the triangle where no weight is negative.
    const Vector3d weights = corners.inverse() * direction;
    const double scale = weights.cwiseAbs().maxCoeff();
    result.Doubtful = result.Doubtful || weights.cwiseAbs().minCoeff() < 1e-9 * scale;
    if (weights.minCoeff() >= 0)
    {
      result.Hits.emplace_back(1 / weights.sum(), static_cast<int>(cellId));
    }
  }
  std::sort(result.Hits.begin(), result.Hits.end());
  return result;
}
}

TEST(Rasteriser, AgreesWithRayCastingOnATriangleSoup)
{
  const TriangleMesh mesh = TriangleSoup(80, 0.6, 1);
  const Camera camera = SkewedCamera();
  const ItemBuffer nearest = Rasterise(mesh, camera);
  const DepthRange range = RasteriseRange(mesh, camera);
  EXPECT_EQ(RasteriseDepth(mesh, camera).Values, nearest.Depth.Values);
  int compared = 0;
  for (int y = 0; y < camera.Height; ++y)
  {
    for (int x = 0; x < camera.Width; ++x)
    {
      const RayHits rays = CastRay(mesh, camera, x, y);
      if (rays.Doubtful)
      {
        continue;
      }
      ++compared;
      if (rays.Hits.empty())
      {
        EXPECT_EQ(nearest.CellId(x, y), -1);
        EXPECT_EQ(range.Nearest(x, y), std::numeric_limits<float>::infinity());
        EXPECT_EQ(range.Farthest(x, y), 0);
        continue;
      }
      EXPECT_EQ(nearest.CellId(x, y), rays.Hits.front().second);
      EXPECT_EQ(range.Nearest(x, y), nearest.Depth(x, y));
      // Depths are stored as float: seven digits.
      EXPECT_NEAR(nearest.Depth(x, y), rays.Hits.front().first, 4e-6);
      EXPECT_NEAR(range.Farthest(x, y), rays.Hits.back().first, 4e-6);
    }
  }
  EXPECT_GT(compared, 64 * 48 * 9 / 10);
}

TEST(Rasteriser, SharedEdgesLeaveNoCracks)
{
  // A jittered grid wider than the frame, and one whose edges run through the pixels' centres.
  Camera camera;
  camera.K << 1, 0, 0, 0, 1, 0, 0, 0, 1;
  camera.Width = 64;
  camera.Height = 48;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.45, 0.45);
  for (const double jitter : { 0.0, 1.0 })
  {
    TriangleMesh mesh = RectangleMesh(40, 40, 1, 80);
    for (Vector3d& point : mesh.Points)
    {
      point += Vector3d(32, 24, 0) + jitter * Vector3d(uniform(random), uniform(random), 0);
      point *= 1 + 0.3 * jitter * std::abs(uniform(random));
    }
    const ItemBuffer buffer = Rasterise(mesh, camera);
    EXPECT_EQ(std::count(buffer.CellId.Values.begin(), buffer.CellId.Values.end(), -1), 0);
  }
}

TEST(Rasteriser, TheLowestIdWinsATie)
{
  TriangleMesh mesh = RectangleMesh(5, 5);
  mesh.Triangles = { mesh.Triangles[1], mesh.Triangles[0], mesh.Triangles[0], mesh.Triangles[1] };
  const ItemBuffer buffer = Rasterise(mesh, SkewedCamera());
  EXPECT_THAT(buffer.CellId.Values, testing::Each(testing::AnyOf(0, 1)));
}

TEST(Rasteriser, DrawsBothSidesAndSkipsWhatReachesBehindTheCamera)
{
  TriangleMesh mesh = RectangleMesh(0.2, 0.2);
  const ItemBuffer front = Rasterise(mesh, OnRing(0));
  for (Eigen::Vector3i& t : mesh.Triangles)
  {
    std::swap(t[0], t[1]);
  }
  EXPECT_EQ(front.Depth.Values, Rasterise(mesh, OnRing(0)).Depth.Values);
  mesh.Points[0].z() = 5; // the camera stands at 4
  const ItemBuffer cut = Rasterise(mesh, OnRing(0));
  EXPECT_TRUE(std::none_of(
    cut.CellId.Values.begin(), cut.CellId.Values.end(), [](int id) { return id >= 0; }));
}

TEST(Rasteriser, AnEmptyMeshIsBackground)
{
  const ItemBuffer buffer = Rasterise({}, OnRing(0));
  EXPECT_EQ(buffer.CellId.Width, 160);
  EXPECT_THAT(buffer.CellId.Values, testing::Each(-1));
}

TEST(Rasteriser, SameBitsWithOneAndMoreThreads)
{
  const TriangleMesh mesh = TriangleSoup(300, 0.5, 7);
  const ItemBuffer one = Rasterise(mesh, OnRing(10, 0, 4, SmallPictureK(100)));
  const ItemBuffer three = Rasterise(mesh, OnRing(10, 0, 4, SmallPictureK(100)), InThreads(3));
  EXPECT_EQ(one.CellId.Values, three.CellId.Values);
  EXPECT_EQ(one.Depth.Values, three.Depth.Values);
}

TEST(Rasteriser, SubRaysSeeWhatAPictureThreeTimesAsLargeSees)
{
  const Camera camera = SkewedCamera();
  Camera fine = camera;
  fine.K.topRows<2>() *= 3;
  // Pixel x covers three pixels whose middle is 3 x + 1.
  fine.K(0, 2) += 1;
  fine.K(1, 2) += 1;
  fine.Width *= 3;
  fine.Height *= 3;
  const TriangleMesh mesh = TriangleSoup(60, 0.6, 2);
  const ItemBuffer detailed = Rasterise(mesh, fine);
  Image<std::uint8_t> chosen(camera.Width, camera.Height);
  for (std::size_t i = 0; i < chosen.Values.size(); i += 2)
  {
    chosen.Values[i] = 1;
  }
  const Subsamples rays = ProjectedMesh(mesh, camera, {}).RasteriseSubsamples(chosen, 3);
  int different = 0;
  int hits = 0;
  for (int y = 0; y < fine.Height; ++y)
  {
    for (int x = 0; x < fine.Width; ++x)
    {
      const bool hasRays = rays.Index(x / 3, y / 3) >= 0;
      ASSERT_EQ(hasRays, chosen(x / 3, y / 3) == 1);
      if (hasRays)
      {
        const std::size_t ray = rays.First(x / 3, y / 3) + rays.Grid.Stride * (y % 3) + x % 3;
        const bool same = rays.CellId[ray] == detailed.CellId(x, y);
        different += !same;
        hits += detailed.Hit(x, y);
        if (same && detailed.Hit(x, y))
        {
          EXPECT_NEAR(rays.Depth[ray], detailed.Depth(x, y), 1e-5);
        }
      }
    }
  }
  EXPECT_GT(hits, 1000);
  // The same rays; rounding may decide otherwise only where one runs exactly through an edge.
  EXPECT_LE(different, 1);
  const Subsamples threads =
    ProjectedMesh(mesh, camera, InThreads(3)).RasteriseSubsamples(chosen, 3);
  EXPECT_EQ(threads.CellId, rays.CellId);
  EXPECT_EQ(threads.Depth, rays.Depth);
}

TEST(Rasteriser, OcclusionDepthComparesWithTheDeepestOfNineNeighbours)
{
  Image<float> depth(5, 5, 1, 2.f);
  depth(2, 1) = 2.5f;
  depth(4, 4) = std::numeric_limits<float>::infinity();
  const auto ref = std::as_const(depth).Ref();
  EXPECT_DOUBLE_EQ(OcclusionDepth(ref, Vector2d(1.6, 2.4), 3), 0.5); // (2,2) sees (2,1)
  EXPECT_DOUBLE_EQ(OcclusionDepth(ref, Vector2d(0, 4), 3), 1);
  EXPECT_DOUBLE_EQ(OcclusionDepth(ref, Vector2d(4, 4), 1.5), -0.5); // infinity is no surface
  EXPECT_EQ(OcclusionDepth(ref, Vector2d(9, 9), 3), -std::numeric_limits<double>::infinity());
}
