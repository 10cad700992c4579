// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/ViewSelection.h"
#include "hull/VisualHull.h"
#include "silhouettes/SilhouetteField.h"
#include "support/Expect.h"
#include "support/Scene.h"
#include "support/SphereScene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

using namespace novelview;
using namespace support;

namespace
{
/** Distance in pixels, positive inside, of a point to the outline of a sphere about the origin. */
double InsideSphereOutlinePx(const Camera& camera, const Vector3d& point)
{
  const Vector3d centre = camera.Centre();
  const Vector3d ray = (point - centre).normalized();
  const double fromAxis = centre.cross(ray).norm(); // of the ray to the sphere's middle
  return (Radius - fromAxis) / camera.PixelFootprint(camera.Depth(point));
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
  // A sphere whose radius is this many spacings, at one sample per 0.7 x 0.7 at the densest.
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
  options.Box.emplace();
  options.Box->fill(10 * spacing);
  std::fill_n(options.Box->begin(), 3, -10 * spacing);
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
  options.Box = { -0.6, -0.6, -0.6, 0.6, 0.6, 0.6 };
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

TEST(VisualHull, AGivenBoxWasRefusedInsteadOfBoundingTheHull)
{
  const auto views = ViewsOf(SpherePhotos());
  const VisualHullResult whole = ComputeVisualHull(views);
  VisualHullOptions options;
  options.Box = { -1, -1, -1, 1, 0.2, 1 };
  const VisualHullResult cut = ComputeVisualHull(views, options);
  // Samples are found to a small part of the spacing.
  const double tolerance = 1e-3 * cut.Spacing;
  int onFace = 0;
  double farthest = 0;
  for (std::size_t i = 0; i < cut.Samples.Points.size(); ++i)
  {
    const Vector3d& point = cut.Samples.Points[i];
    EXPECT_LT(point.y(), 0.2 + tolerance);
    if (point.y() > 0.2 - tolerance)
    {
      ++onFace;
      farthest = std::max(farthest, std::hypot(point.x(), point.z()));
    }
  }
  // A disc of the sphere's section, with a sample per cell.
  const double section = std::sqrt(Radius * Radius - 0.2 * 0.2);
  EXPECT_GT(onFace, 0.8 * std::numbers::pi * section * section / (cut.Spacing * cut.Spacing));
  EXPECT_NEAR(farthest, section, 3 * cut.Spacing);
  EXPECT_LT(cut.Samples.Points.size(), whole.Samples.Points.size());
  EXPECT_TRUE(cut.CutByBox);
  options.Box = { -1, -1, -1, 1, 1, 1 };
  EXPECT_FALSE(ComputeVisualHull(views, options).CutByBox);
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
  options.Box = { -1, 1e12 - 1, -1, 1, 1e12 + 1, 1 };
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
