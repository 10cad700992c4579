// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/ViewSelection.h"
#include "hull/VisualHull.h"
#include "silhouettes/SearchBox.h"
#include "silhouettes/SilhouetteField.h"
#include "support/Expect.h"
#include "support/Scene.h"

#include <algorithm>
#include <map>

using namespace novelview;
using namespace support;

namespace
{
constexpr double Radius = 0.5;

/** Leaves room around the object: what no frame shows may be anything, and is not the subject. */
constexpr double Focal = 300;

Camera RoomyCamera(double angleDeg, double elevationDeg = 0)
{
  return OnRing(angleDeg, elevationDeg, 4, SmallPictureK(Focal));
}

/** A ring of eight and one camera from above, so that the hull is close to the sphere. */
std::vector<Camera> NineCameras()
{
  std::vector<Camera> cameras = Ring(8, 45, Focal);
  cameras.push_back(RoomyCamera(20, 70));
  return cameras;
}

const std::vector<Photo>& SpherePhotos()
{
  static const std::vector<Photo> photos =
    TakeAll(Sphere(Vector3d::Zero(), Radius), Plain(200, 200, 200), NineCameras());
  return photos;
}

/** Distance in pixels, positive inside, of a point to the outline of a sphere about the origin. */
double InsideSphereOutlinePx(const Camera& camera, const Vector3d& point)
{
  const Vector3d centre = camera.Centre();
  const Vector3d ray = (point - centre).normalized();
  const double fromAxis = centre.cross(ray).norm(); // of the ray to the sphere's middle
  return (Radius - fromAxis) / camera.PixelFootprint(camera.Depth(point));
}

std::vector<Vector3d> RandomPoints(int count, double halfSide, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-halfSide, halfSide);
  std::vector<Vector3d> points(count);
  for (Vector3d& point : points)
  {
    point = { uniform(random), uniform(random), uniform(random) };
  }
  return points;
}

/** Replaces a mask and what is derived from it. */
void SetMask(Photo& photo, Image<std::uint8_t> mask)
{
  photo.Mask = std::move(mask);
  photo.ContourDistance = SignedContourDistance(std::as_const(photo.Mask).Ref());
}
}

TEST(VisualHull, EverySampleIsOnOneOutlineAndInsideAllOthers)
{
  const VisualHullResult hull = ComputeVisualHull(ViewsOf(SpherePhotos()));
  ASSERT_GT(hull.Samples.Points.size(), 1000u);
  for (const Vector3d& point : hull.Samples.Points)
  {
    double nearest = 1e9;
    for (const Photo& photo : SpherePhotos())
    {
      const double px = InsideSphereOutlinePx(photo.Cam, point);
      nearest = std::min(nearest, std::abs(px));
      // Half a pixel is what the issue asks of the samples.
      EXPECT_GT(px, -0.5);
    }
    EXPECT_LT(nearest, 0.5);
  }
}

TEST(VisualHull, ContainsTheObject)
{
  const DistanceFunction torus = TorusDistance(0.4, 0.12);
  const auto photos = TakeAll(Traced(torus, 0.6), Plain(200, 200, 200), NineCameras());
  const auto views = ViewsOf(photos);
  const SilhouetteField field(views);
  const double tolerance = 0.5 * MedianFootprint(views, Vector3d::Zero()); // half a pixel
  int inside = 0;
  for (const Vector3d& point : RandomPoints(20000, 0.55, 1))
  {
    if (torus(point) < 0)
    {
      ++inside;
      EXPECT_GT(field.Value(point), -tolerance);
    }
  }
  EXPECT_GT(inside, 500);
  for (const Vector3d& sample : ComputeVisualHull(views).Samples.Points)
  {
    EXPECT_GT(torus(sample), -tolerance);
  }
}

TEST(VisualHull, NormalsAreUnitAndPointOutwards)
{
  const VisualHullResult hull = ComputeVisualHull(ViewsOf(SpherePhotos()));
  ASSERT_EQ(hull.Samples.Normals.size(), hull.Samples.Points.size());
  for (std::size_t i = 0; i < hull.Samples.Points.size(); ++i)
  {
    EXPECT_NEAR(hull.Samples.Normals[i].norm(), 1, 1e-9);
    // The hull is star-shaped about the sphere's middle, which lies deep inside every cone.
    EXPECT_GT(hull.Samples.Normals[i].dot(hull.Samples.Points[i]), 0);
  }
}

TEST(VisualHull, SamplesLeaveNoHoles)
{
  const auto views = ViewsOf(SpherePhotos());
  const VisualHullResult hull = ComputeVisualHull(views);
  const SilhouetteField field(views);
  for (const Vector3d& direction : RandomPoints(300, 1, 2))
  {
    double inside = 0;
    double outside = 0.7;
    for (int step = 0; step < 40; ++step)
    {
      const double middle = 0.5 * (inside + outside);
      (field.Value(middle * direction.normalized()) >= 0 ? inside : outside) = middle;
    }
    const Vector3d onHull = inside * direction.normalized();
    double nearest = 1e9;
    for (const Vector3d& sample : hull.Samples.Points)
    {
      nearest = std::min(nearest, (sample - onHull).norm());
    }
    // Every cell the surface crosses has a sample, in it or not a spacing away: no further than a
    // cell's diagonal, and as much again where the surface only touches a corner of its cell.
    EXPECT_LT(nearest, 2 * std::sqrt(3.0) * hull.Spacing);
  }
}

TEST(VisualHull, TheSurfaceIsClosedAndFacesOutwards)
{
  const auto views = ViewsOf(SpherePhotos());
  const VisualHullResult hull = ComputeVisualHull(views);
  std::map<std::pair<int, int>, int> edges; // uses in this direction less those in the other
  double volume = 0;
  for (const Eigen::Vector3i& t : hull.Surface.Triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      edges[{ low, high }] += t[k] == low ? 1 : -1;
    }
    const std::vector<Vector3d>& p = hull.Surface.Points;
    volume += p[t[0]].dot(p[t[1]].cross(p[t[2]])) / 6;
  }
  for (const auto& [edge, balance] : edges)
  {
    EXPECT_EQ(balance, 0) << edge.first << ", " << edge.second;
  }
  // That of the hull, which is star-shaped, by rays in many directions; these give it to a percent.
  const SilhouetteField field(views);
  double expected = 0;
  constexpr int rays = 2000;
  for (const Vector3d& direction : RandomPoints(rays, 1, 3))
  {
    double inside = 0;
    double outside = 0.7;
    for (int step = 0; step < 20; ++step)
    {
      const double middle = 0.5 * (inside + outside);
      (field.Value(middle * direction.normalized()) >= 0 ? inside : outside) = middle;
    }
    expected += 4.0 / 3 * 3.14159 * inside * inside * inside / rays;
  }
  EXPECT_NEAR(volume, expected, 0.03 * expected);
  // Samples are thinned out after it was made, and are of its points.
  EXPECT_GT(hull.Surface.Points.size(), hull.Samples.Points.size());
}

TEST(VisualHull, SamplesOfOneSurfaceKeepTheirDistance)
{
  const VisualHullResult hull = ComputeVisualHull(ViewsOf(SpherePhotos()));
  const std::vector<Vector3d>& points = hull.Samples.Points;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      if ((points[i] - points[j]).norm() < 0.699 * hull.Spacing)
      {
        EXPECT_LT(hull.Samples.Normals[i].dot(hull.Samples.Normals[j]), 0.501);
      }
    }
  }
  // A sphere of so many spacings' radius, at one sample per 0.7 x 0.7 at the densest.
  const double area = 4 * 3.1416 * Radius * Radius / (hull.Spacing * hull.Spacing);
  EXPECT_LT(points.size(), area / 0.49);
  EXPECT_GT(points.size(), area / 2) << "and more than half of one per spacing squared stay";
}

TEST(VisualHull, BothSidesOfAThinSheetAreSampled)
{
  const double half = 0.025;
  const auto photos = TakeAll(Box(Vector3d(-0.4, -0.4, -half), Vector3d(0.4, 0.4, half)),
    Plain(200, 200, 200), Ring(8, 45, Focal));
  VisualHullOptions options;
  options.SpacingPx = 7;
  const double spacing = options.SpacingPx * MedianFootprint(ViewsOf(photos), Vector3d::Zero());
  ASSERT_LT(2 * half, 0.65 * spacing) << "the sheet is to be thinner than samples' distance";
  // With a plane of the lattice in the middle of the sheet, which else falls between two.
  options.Box =
    Eigen::AlignedBox3d(Vector3d::Constant(-10 * spacing), Vector3d::Constant(10 * spacing));
  const VisualHullResult hull = ComputeVisualHull(ViewsOf(photos), options);
  int front = 0;
  int back = 0;
  for (std::size_t i = 0; i < hull.Samples.Points.size(); ++i)
  {
    const Vector3d& p = hull.Samples.Points[i];
    if (std::max(std::abs(p.x()), std::abs(p.y())) < 0.3)
    {
      ++(hull.Samples.Normals[i].z() > 0 ? front : back);
    }
  }
  // 0.6 x 0.6 of sheet, a sample per spacing squared.
  const double expected = 0.36 / (spacing * spacing);
  EXPECT_GT(front, 0.6 * expected);
  EXPECT_GT(back, 0.6 * expected);
}

TEST(VisualHull, TheSmallerOfTwoObjectsIsDroppedAndCounted)
{
  const Shape two =
    Union({ Sphere(Vector3d(0, 0.2, 0), 0.25), Sphere(Vector3d(0, -0.3, 0), 0.15) });
  const auto photos = TakeAll(two, Plain(200, 200, 200), Ring(8, 45, Focal));
  VisualHullOptions options;
  const VisualHullResult largest = ComputeVisualHull(ViewsOf(photos), options);
  options.KeepAllComponents = true;
  const VisualHullResult all = ComputeVisualHull(ViewsOf(photos), options);
  EXPECT_EQ(all.Components, 2);
  EXPECT_EQ(all.DroppedComponents, 0);
  EXPECT_EQ(largest.Components, 2);
  EXPECT_EQ(largest.DroppedComponents, 1);
  EXPECT_EQ(largest.DroppedSamples + largest.Samples.Points.size(), all.Samples.Points.size());
  EXPECT_GT(largest.DroppedSamples, 0u);
  for (const std::vector<Vector3d>* points : { &largest.Samples.Points, &largest.Surface.Points })
  {
    for (const Vector3d& point : *points)
    {
      EXPECT_GT(point.y(), -0.1); // between the two
    }
  }
  EXPECT_GT(all.Surface.Triangles.size(), largest.Surface.Triangles.size());
}

TEST(VisualHull, GhostsThatTwoViewsCannotTellFromObjectsAreComponents)
{
  const Shape two =
    Union({ Sphere(Vector3d(-0.35, 0, -0.35), 0.15), Sphere(Vector3d(0.35, 0, 0.35), 0.15) });
  const auto photos = TakeAll(two, Plain(200, 200, 200), { RoomyCamera(0), RoomyCamera(90) });
  const VisualHullResult hull = ComputeVisualHull(ViewsOf(photos));
  EXPECT_EQ(hull.Components, 4);
  EXPECT_EQ(hull.DroppedComponents, 3);
}

TEST(VisualHull, WhatAViewHasOutsideItsFrameIsNotCarvedByIt)
{
  std::vector<Camera> cameras = NineCameras();
  cameras[2].K(0, 2) += 75; // half of the sphere leaves the frame on the right
  cameras[5].K(1, 2) -= 70; // and here at the top
  const auto photos = TakeAll(Sphere(Vector3d::Zero(), Radius), Plain(200, 200, 200), cameras);
  const auto views = ViewsOf(photos);
  const SilhouetteField field(views);
  const double tolerance = 0.5 * MedianFootprint(views, Vector3d::Zero());
  for (const Vector3d& point : RandomPoints(5000, Radius, 3))
  {
    if (point.norm() < Radius)
    {
      EXPECT_GT(field.Value(point), -tolerance);
    }
  }
  const VisualHullResult hull = ComputeVisualHull(views);
  Eigen::AlignedBox3d extent;
  for (const Vector3d& sample : hull.Samples.Points)
  {
    extent.extend(sample);
  }
  // A pixel: the box is measured at samples, which lie up to half a spacing off the extremes.
  EXPECT_LT(extent.min().maxCoeff(), -Radius + 2 * tolerance);
  EXPECT_GT(extent.max().minCoeff(), Radius - 2 * tolerance);
}

TEST(VisualHull, AnEmptyMaskIsNamed)
{
  auto photos = SpherePhotos();
  SetMask(photos[3], Image<std::uint8_t>(160, 120));
  ExpectError([&] { ComputeVisualHull(ViewsOf(photos)); }, "view p3: the mask is empty");
  VisualHullOptions options;
  options.Box.emplace(Vector3d::Constant(-0.6), Vector3d::Constant(0.6));
  ExpectError([&] { ComputeVisualHull(ViewsOf(photos), options); },
    "view p3: its mask carves everything away");
}

TEST(VisualHull, AMaskThatCarvesEverythingAwayIsNamed)
{
  auto photos = SpherePhotos();
  // Two blobs in opposite corners: their rectangle meets the other views', they do not.
  Image<std::uint8_t> corners(160, 120);
  for (int i = 3; i < 8; ++i)
  {
    for (int j = 3; j < 8; ++j)
    {
      corners(i, j) = corners(159 - i, 119 - j) = 255;
    }
  }
  SetMask(photos[4], corners);
  ExpectError(
    [&] { ComputeVisualHull(ViewsOf(photos)); }, "view p4: its mask carves everything away");
}

TEST(VisualHull, ReachingTheGivenBoxIsAnError)
{
  VisualHullOptions options;
  options.Box.emplace(Vector3d(-1, -1, -1), Vector3d(1, 0.3, 1));
  ExpectError([&] { ComputeVisualHull(ViewsOf(SpherePhotos()), options); },
    "visual hull: it reaches the search box at max y = 0.3");
}

TEST(VisualHull, EndsThoughTheOriginIsTooFarAwayToTellPointsApart)
{
  // At 1e12 neighbouring numbers are a thousand times the samples' accuracy apart.
  std::vector<Photo> photos = SpherePhotos();
  for (Photo& photo : photos)
  {
    photo.Cam.T -= photo.Cam.R * Vector3d(0, 1e12, 0);
  }
  VisualHullOptions options;
  options.Box.emplace(Vector3d(-1, 1e12 - 1, -1), Vector3d(1, 1e12 + 1, 1));
  try
  {
    ComputeVisualHull(ViewsOf(photos), options);
  }
  catch (const Error&)
  {
    // As good an end: the cameras are off by as much.
  }
}

TEST(VisualHull, SameBitsWithOneAndMoreThreads)
{
  const auto views = ViewsOf(SpherePhotos());
  const VisualHullResult one = ComputeVisualHull(views);
  const VisualHullResult three = ComputeVisualHull(views, {}, InThreads(3));
  EXPECT_EQ(one.Samples.Points, three.Samples.Points);
  EXPECT_EQ(one.Samples.Normals, three.Samples.Normals);
}

namespace
{
/** Classifies random balls and looks the field up in each that is said to be certain. */
void ExpectClassificationHolds(const std::vector<Camera>& cameras, double reach, int atLeast)
{
  const auto photos = TakeAll(Sphere(Vector3d::Zero(), Radius), Plain(200, 200, 200), cameras);
  const auto views = ViewsOf(photos);
  const SilhouetteField field(views);
  const auto offsets = RandomPoints(64, 1, 5);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(0.01, 0.6 * reach);
  int certain = 0;
  for (const Vector3d& centre : RandomPoints(8000, reach, 4))
  {
    const double radius = uniform(random);
    const auto position = field.Classify(centre, radius);
    if (position == SilhouetteField::Position::Mixed)
    {
      continue;
    }
    ++certain;
    for (const Vector3d& offset : offsets)
    {
      const bool inside = field.Value(centre + radius * offset.normalized()) >= 0;
      ASSERT_EQ(inside, position == SilhouetteField::Position::Inside)
        << centre.transpose() << " radius " << radius;
    }
  }
  EXPECT_GT(certain, atLeast);
}
}

TEST(SilhouetteField, ClassifiesABallOnlyWhenAllOfItIsThere)
{
  std::vector<Camera> cameras = Ring(3, 60);
  cameras[1].K(0, 2) += 75;
  cameras[2].K(0, 0) *= 1.6; // pixels that are not square
  ExpectClassificationHolds(cameras, 2.5, 800);
}

TEST(SilhouetteField, ClassifiesBallsFarOffTheAxisOfAWideAngleCamera)
{
  // Half of the sphere and more lies outside these frames, at steep angles to the axis.
  std::vector<Camera> cameras;
  for (const double angle : { 0.0, 100.0 })
  {
    cameras.push_back(OnRing(angle, 0, 1.2, SmallPictureK(60)));
    cameras.back().Width = 80;
    cameras.back().K(0, 2) = 75;
  }
  ExpectClassificationHolds(cameras, 2.5, 200);
}

TEST(SilhouetteField, ValueIsTheLeastConeDistanceInWorldUnits)
{
  const auto views = ViewsOf(SpherePhotos());
  const SilhouetteField field(views);
  // At the middle the nearest cone is about the sphere's radius away; a pixel of tolerance.
  EXPECT_NEAR(field.Value(Vector3d::Zero()), Radius, 4 / Focal);
  int deciding = 7;
  EXPECT_EQ(field.Value(Vector3d(0, 50, 0), deciding), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(deciding, -1);
}

TEST(SearchBox, EnclosesTheObjectWhenAllCamerasStandOnOneSide)
{
  std::vector<Camera> cameras;
  for (const double angle : { -40.0, -20.0, 0.0, 20.0, 40.0 })
  {
    cameras.push_back(RoomyCamera(angle, angle / 2));
  }
  const auto photos = TakeAll(Sphere(Vector3d::Zero(), Radius), Plain(200, 200, 200), cameras);
  const Eigen::AlignedBox3d box = FindSearchBox(ViewsOf(photos));
  EXPECT_TRUE(box.contains(Vector3d::Constant(-Radius).eval()));
  EXPECT_TRUE(box.contains(Vector3d::Constant(Radius).eval()));
  // Across the viewing directions the box is tight; twice the sphere leaves room for perspective.
  EXPECT_LT(box.sizes().y(), 4 * Radius);
  EXPECT_NO_THROW(ComputeVisualHull(ViewsOf(photos)));
}

TEST(SearchBox, SilhouettesWithoutACommonPointNameTheOddOneOut)
{
  auto photos = SpherePhotos();
  photos[1].Cam.T.x() += 3; // looks past the object by three of its diameters
  ExpectError([&] { FindSearchBox(ViewsOf(photos)); },
    "view p1: its silhouette and those of the other views have no point in common");
}

TEST(SearchBox, SilhouettesThatReachTheFrameEverywhereBoundNothing)
{
  auto photos = SpherePhotos();
  for (Photo& photo : photos)
  {
    SetMask(photo, Image<std::uint8_t>(160, 120, 1, 255));
  }
  ExpectError([&] { FindSearchBox(ViewsOf(photos)); }, "do not bound the object on every side");
}
