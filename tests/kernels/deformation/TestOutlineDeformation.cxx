// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/OutlineDeformation.h"
#include "deformation/OutlineEnergy.h"
#include "geometry/NovelProjection.h"
#include "geometry/Visibility.h"
#include "stereo/PhotoConsistency.h"
#include "support/Expect.h"
#include "support/Scene.h"

using namespace novelview;
using namespace support;

namespace
{
/** An item buffer from a drawing, # = model. */
ItemBuffer Drawn(const std::vector<std::string>& rows)
{
  ItemBuffer buffer;
  const int width = static_cast<int>(rows.front().size());
  const int height = static_cast<int>(rows.size());
  buffer.CellId = Image<int>(width, height, 1, -1);
  buffer.Depth = Image<float>(width, height, 1, std::numeric_limits<float>::infinity());
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      buffer.CellId(x, y) = rows[y][x] == '#' ? 0 : -1;
    }
  }
  return buffer;
}

constexpr double TrueRadius = 0.5;
constexpr double HullRadius = 0.52; ///< two pixels larger

/** Photographs of a sphere, a larger mesh of it, and a camera between two of them. */
struct SphereCase
{
  std::vector<Photo> Photos =
    TakeAll(Sphere(Vector3d::Zero(), TrueRadius), Waves(0.25), Ring(12, 30));
  std::vector<View> Views = ViewsOf(Photos);
  TriangleMesh Mesh = SphereMesh(Vector3d::Zero(), HullRadius, 4);
  Camera Novel = OnRing(15);
  std::vector<std::uint8_t> Visible = VisibleVertices(Mesh, Novel);
};

const SphereCase& TheCase()
{
  static const SphereCase sphere;
  return sphere;
}

struct Recorded
{
  std::vector<int> Iterations;
  std::vector<TriangleMesh> Meshes;
  std::vector<std::vector<PointEnergy>> Energies;
  std::vector<std::vector<std::uint8_t>> Active;
  std::vector<long> Moved;

  DeformationListener Listener()
  {
    return [this](const DeformationState& state)
    {
      this->Iterations.push_back(state.Iteration);
      this->Meshes.push_back(*state.Mesh);
      this->Energies.push_back(*state.Energies);
      this->Active.push_back(*state.Active);
      this->Moved.push_back(state.PointsMoved);
    };
  }
};

double MeanTotal(const Recorded& recorded, std::size_t i)
{
  double sum = 0;
  int count = 0;
  for (std::size_t ptId = 0; ptId < recorded.Energies[i].size(); ++ptId)
  {
    if (recorded.Active[i][ptId])
    {
      sum += recorded.Energies[i][ptId].Total;
      ++count;
    }
  }
  return sum / count;
}

/** Distance of a point's viewing ray from the sphere's centre, novel pixels. */
double OffAxisPx(const Vector3d& point, const Camera& novel)
{
  const Vector3d centre = novel.Centre();
  return centre.cross((point - centre).normalized()).norm() /
    novel.PixelFootprint(novel.Depth(point));
}

/** Mean distance of the active points' viewing rays to the sphere's outline, novel pixels. */
double OffOutlinePx(const DeformationResult& result, const Camera& novel)
{
  double sum = 0;
  int count = 0;
  const Vector3d centre = novel.Centre();
  for (std::size_t ptId = 0; ptId < result.Mesh.Points.size(); ++ptId)
  {
    if (result.Active[ptId])
    {
      const Vector3d& point = result.Mesh.Points[ptId];
      const double fromAxis = centre.cross((point - centre).normalized()).norm();
      sum += std::abs(fromAxis - TrueRadius) / novel.PixelFootprint(novel.Depth(point));
      ++count;
    }
  }
  return sum / count;
}
}

TEST(OutlineDirection, PointsAtTheCentroidOfTheBackground)
{
  const ItemBuffer buffer = Drawn({ "###..", "###..", "###..", "#####", "#####" });
  // Background: columns 3 and 4 of rows 0 to 2, centroid (3.5, 1).
  const auto direction = OutlineDirection(buffer, Vector2d(2, 2));
  ASSERT_TRUE(direction);
  EXPECT_LT((*direction - Vector2d(1.5, -1).normalized()).norm(), 1e-12);
  // The window is that of the nearest pixel, the vector starts at the projection itself.
  const auto fromOff = OutlineDirection(buffer, Vector2d(2.25, 1.75));
  ASSERT_TRUE(fromOff);
  EXPECT_LT((*fromOff - Vector2d(1.25, -0.75).normalized()).norm(), 1e-12);
}

TEST(OutlineDirection, IsNothingWithoutModelOrBackgroundOrSide)
{
  EXPECT_FALSE(OutlineDirection(Drawn(std::vector<std::string>(5, "#####")), Vector2d(2, 2)));
  EXPECT_FALSE(OutlineDirection(Drawn(std::vector<std::string>(5, ".....")), Vector2d(2, 2)));
  EXPECT_FALSE(
    OutlineDirection(Drawn({ ".....", ".....", "..#..", ".....", "....." }), Vector2d(2, 2)));
}

TEST(OutlineDirection, OutsideTheFrameIsNeitherModelNorBackground)
{
  const auto direction =
    OutlineDirection(Drawn({ "#...", "#...", "#...", "#...", "#..." }), Vector2d(0, 2));
  ASSERT_TRUE(direction);
  EXPECT_LT((*direction - Vector2d(1, 0)).norm(), 1e-12);
}

TEST(OnContour, NeedsModelAndBackgroundWithinAPixel)
{
  const ItemBuffer buffer = Drawn({ "####..", "####..", "####..", "####..", "####.." });
  EXPECT_TRUE(OnContour(buffer, Vector2d(3.4, 2)));
  EXPECT_TRUE(OnContour(buffer, Vector2d(4.4, 2)));
  EXPECT_FALSE(OnContour(buffer, Vector2d(2.4, 2)));
  EXPECT_FALSE(OnContour(buffer, Vector2d(5, 2)));
  EXPECT_FALSE(OnContour(buffer, Vector2d(0, 0))) << "the frame is no contour";
}

TEST(OutlineEnergies, ContourIsTheMeanTruncatedDistance)
{
  std::vector<Photo> photos =
    TakeAll(Sphere(Vector3d::Zero(), TrueRadius), Plain(9, 9, 9), { OnRing(0), OnRing(30) });
  photos[0].ContourDistance = Image<float>(160, 120, 1, -3.f); // outside counts like inside
  photos[1].ContourDistance = Image<float>(160, 120, 1, 20.f);
  const auto views = ViewsOf(photos);
  EXPECT_DOUBLE_EQ(OutlineContourEnergy(Vector3d::Zero(), views, { 0 }, 8), 3. / 8);
  EXPECT_DOUBLE_EQ(OutlineContourEnergy(Vector3d::Zero(), views, { 0, 1 }, 8), (3. / 8 + 1) / 2);
  EXPECT_DOUBLE_EQ(OutlineContourEnergy(Vector3d(0, 0, 9), views, { 0 }, 8), 0) << "not seen";
  EXPECT_DOUBLE_EQ(OutlineContourEnergy(Vector3d::Zero(), views, {}, 8), 0);
}

TEST(OutlineEnergies, SmoothnessIsTheMeanCosineToTheNeighbours)
{
  const Vector3d v = Vector3d::UnitX();
  EXPECT_DOUBLE_EQ(OutlineSmoothnessEnergy(Vector3d::Zero(), v, { { 0, 2, 0 }, { 0, -1, 0 } }), 0);
  // Cosines 3/5 and -1: the mean of their absolute values.
  EXPECT_DOUBLE_EQ(
    OutlineSmoothnessEnergy(Vector3d::Zero(), v, { { 3, 4, 0 }, { -2, 0, 0 } }), 0.8);
  EXPECT_DOUBLE_EQ(OutlineSmoothnessEnergy(Vector3d::Zero(), v, {}), 0);
  EXPECT_DOUBLE_EQ(OutlineSmoothnessEnergy(v, v, { v }), 0) << "a neighbour at the same place";
}

TEST(OutlineEnergies, PhotoIsTheMeanWindowDifferenceOfKeyAndSecondaries)
{
  const SphereCase& sphere = TheCase();
  const Vector3d point(0.1, 0.1, 0.45);
  const auto difference = [&](int other)
  {
    return WindowMatcher(sphere.Views[0], sphere.Views[0].Cam.Project(point), 3)
      .ContrastDifference(sphere.Views[other], sphere.Views[other].Cam.Project(point));
  };
  EXPECT_DOUBLE_EQ(
    OutlinePhotoEnergy(point, sphere.Views, 0, { 1, 11 }, 3), (difference(1) + difference(11)) / 2);
  EXPECT_DOUBLE_EQ(OutlinePhotoEnergy(point, sphere.Views, 0, {}, 3), 1);
  EXPECT_DOUBLE_EQ(OutlinePhotoEnergy(Vector3d(0, 0, 9), sphere.Views, 0, { 1 }, 3), 1);
}

TEST(OutlineDeformation, BringsAHullTwoPixelsTooLargeNearerToTheOutline)
{
  const SphereCase& sphere = TheCase();
  OutlineOptions measureOnly;
  measureOnly.Iterations = 0;
  const auto before =
    DeformOutline(sphere.Mesh, sphere.Visible, sphere.Views, sphere.Novel, measureOnly);
  const auto after = DeformOutline(sphere.Mesh, sphere.Visible, sphere.Views, sphere.Novel);
  EXPECT_EQ(before.Iterations, 0);
  const double start = OffOutlinePx(before, sphere.Novel);
  EXPECT_GT(
    start, 1.2); // two pixels at the equator, less at vertices that stand before the boundary
  // In pictures this small few windows tell a move of two pixels from none: points that have no
  // evidence stay on the hull, and those that move go the right way.
  EXPECT_LT(OffOutlinePx(after, sphere.Novel), 0.995 * start);
  for (std::size_t ptId = 0; ptId < sphere.Mesh.Points.size(); ++ptId)
  {
    if (after.Active[ptId])
    {
      EXPECT_LT(OffAxisPx(after.Mesh.Points[ptId], sphere.Novel),
        OffAxisPx(sphere.Mesh.Points[ptId], sphere.Novel) + 0.5);
    }
  }
}

TEST(OutlineDeformation, MovedPointsStayInThePlaneParallelToTheNovelImage)
{
  const SphereCase& sphere = TheCase();
  const auto result = DeformOutline(sphere.Mesh, sphere.Visible, sphere.Views, sphere.Novel);
  const double millionth = 1e-6 * BoundingDiagonal(sphere.Mesh.Points);
  int moved = 0;
  for (std::size_t ptId = 0; ptId < sphere.Mesh.Points.size(); ++ptId)
  {
    moved += result.Mesh.Points[ptId] != sphere.Mesh.Points[ptId];
    EXPECT_NEAR(sphere.Novel.Depth(result.Mesh.Points[ptId]),
      sphere.Novel.Depth(sphere.Mesh.Points[ptId]), millionth);
  }
  EXPECT_GT(moved, 20);
}

TEST(OutlineDeformation, NoTriangleFlipsInTheNovelView)
{
  const SphereCase& sphere = TheCase();
  OutlineOptions options;
  options.SearchPx = 6; // more than an edge, so that moves without the check would fold
  options.MaxMovePx = 6;
  options.Beta = 0;
  const auto result =
    DeformOutline(sphere.Mesh, sphere.Visible, sphere.Views, sphere.Novel, options);
  const auto facing = NovelProjection::FacingPart(sphere.Mesh, sphere.Novel);
  EXPECT_EQ(result.Mesh.Triangles, facing.Triangles);
  const auto area = [&](const TriangleMesh& mesh, const Eigen::Vector3i& t)
  {
    return ProjectedArea(sphere.Novel.Project(mesh.Points[t[0]]),
      sphere.Novel.Project(mesh.Points[t[1]]), sphere.Novel.Project(mesh.Points[t[2]]));
  };
  for (const Eigen::Vector3i& t : result.Mesh.Triangles)
  {
    EXPECT_LT(area(sphere.Mesh, t), 0);
    EXPECT_LT(area(result.Mesh, t), 1e-9); // rounding of accumulated moves, square pixels
  }
}

TEST(OutlineDeformation, TheMeanEnergyFallsInEveryIteration)
{
  const SphereCase& sphere = TheCase();
  Recorded recorded;
  const auto result =
    DeformOutline(sphere.Mesh, sphere.Visible, sphere.Views, sphere.Novel, {}, recorded.Listener());
  ASSERT_GT(recorded.Meshes.size(), 2u);
  for (std::size_t i = 1; i < recorded.Meshes.size(); ++i)
  {
    EXPECT_EQ(recorded.Active[i], recorded.Active[0]) << "the outline stays the same points";
    EXPECT_LT(MeanTotal(recorded, i), MeanTotal(recorded, i - 1)) << i;
  }
  for (std::size_t ptId = 0; ptId < result.Energies.size(); ++ptId)
  {
    const PointEnergy& e = result.Energies[ptId];
    EXPECT_NEAR(e.Total, e.Photo + 0.3 * e.Contour + 0.3 * e.Smooth, 1e-12);
    EXPECT_TRUE(result.Active[ptId] || e.Total == 0);
  }
}

TEST(OutlineDeformation, TheListenerHearsEveryIterationOnceAndTheStart)
{
  const SphereCase& sphere = TheCase();
  Recorded recorded;
  OutlineOptions options;
  options.Iterations = 3;
  options.ConvergencePx = 0;
  const auto result = DeformOutline(
    sphere.Mesh, sphere.Visible, sphere.Views, sphere.Novel, options, recorded.Listener());
  // It may end before, when no move lowers the mean energy.
  ASSERT_GE(recorded.Iterations.size(), 3u);
  for (std::size_t i = 0; i < recorded.Iterations.size(); ++i)
  {
    EXPECT_EQ(recorded.Iterations[i], static_cast<int>(i));
  }
  EXPECT_EQ(recorded.Moved.front(), 0);
  EXPECT_GT(recorded.Moved[1], 0);
  EXPECT_EQ(recorded.Meshes.front().Points, sphere.Mesh.Points);
  EXPECT_EQ(recorded.Meshes.back().Points, result.Mesh.Points);
  EXPECT_EQ(result.Iterations, recorded.Iterations.back());
  EXPECT_LE(result.Iterations, 3);
}

TEST(OutlineDeformation, FlatPhotographsMoveNothing)
{
  // On a plain object every window fits every other: E_s says nothing, and the hull is kept.
  const auto photos =
    TakeAll(Sphere(Vector3d::Zero(), TrueRadius), Plain(200, 200, 200), Ring(12, 30));
  const SphereCase& sphere = TheCase();
  const auto result = DeformOutline(sphere.Mesh, sphere.Visible, ViewsOf(photos), sphere.Novel);
  EXPECT_EQ(result.Mesh.Points, sphere.Mesh.Points);
  EXPECT_TRUE(result.Converged);
}

TEST(OutlineDeformation, ThePointsBehindTheOutlineFollow)
{
  const SphereCase& sphere = TheCase();
  const auto result = DeformOutline(sphere.Mesh, sphere.Visible, sphere.Views, sphere.Novel);
  int followed = 0;
  for (std::size_t ptId = 0; ptId < sphere.Mesh.Points.size(); ++ptId)
  {
    followed += !result.Active[ptId] && result.Mesh.Points[ptId] != sphere.Mesh.Points[ptId];
  }
  EXPECT_GT(followed, 40);
}

TEST(OutlineDeformation, InvisiblePointsStay)
{
  const SphereCase& sphere = TheCase();
  const std::vector<std::uint8_t> none(sphere.Mesh.Points.size(), 0);
  const auto result = DeformOutline(sphere.Mesh, none, sphere.Views, sphere.Novel);
  EXPECT_EQ(result.Mesh.Points, sphere.Mesh.Points);
  EXPECT_TRUE(result.Converged);
}

TEST(OutlineDeformation, SameBitsWithOneAndMoreThreads)
{
  const SphereCase& sphere = TheCase();
  const auto one = DeformOutline(sphere.Mesh, sphere.Visible, sphere.Views, sphere.Novel);
  const auto three =
    DeformOutline(sphere.Mesh, sphere.Visible, sphere.Views, sphere.Novel, {}, {}, InThreads(3));
  EXPECT_EQ(one.Mesh.Points, three.Mesh.Points);
  EXPECT_EQ(one.Active, three.Active);
}
