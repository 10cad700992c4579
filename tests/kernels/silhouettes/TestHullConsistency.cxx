// SPDX-License-Identifier: GPL-3.0-or-later
#include "silhouettes/HullConsistency.h"
#include "silhouettes/SilhouetteField.h"
#include "support/Expect.h"
#include "support/Scene.h"
#include "support/TowerScene.h"

#include <cmath>
#include <thread>

using namespace novelview;
using namespace support;

namespace
{
/** Rays of one kind of all views. */
std::vector<SilhouetteRay> RaysOf(const std::vector<View>& views, int count, bool contour)
{
  std::vector<SilhouetteRay> rays;
  for (int id = 0; id < static_cast<int>(views.size()); ++id)
  {
    const auto own = contour ? ContourRays(views, id, count) : AreaRays(views, id, count);
    rays.insert(rays.end(), own.begin(), own.end());
  }
  return rays;
}

/** The residual by its definition, at closely spaced points around the object. */
double DenseResidual(const std::vector<View>& views, const SilhouetteRay& ray)
{
  const Camera& camera = views[ray.ViewId].Cam;
  double best = -16;
  for (double depth = 2.5; depth < 5.5; depth += 0.003)
  {
    const Vector3d x = camera.Unproject(ray.Pixel, depth);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t other = 0; other < views.size(); ++other)
    {
      const Vector2d pixel = views[other].Cam.Project(x);
      if (static_cast<int>(other) != ray.ViewId)
      {
        least = std::min(least, SampleBilinear(views[other].ContourDistance, pixel.x(), pixel.y()));
      }
    }
    best = std::max(best, least);
  }
  return best;
}
}

TEST(HullConsistency, IsWhatADenseSearchFinds)
{
  const std::vector<Photo> photos = BoxPhotos();
  const std::vector<View> views = ViewsOf(photos);
  for (const bool contour : { false, true })
  {
    const auto rays = RaysOf(views, 8, contour);
    const auto agreements = FollowSilhouetteRays(views, rays);
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      // Samples are half a pixel apart, so the best point is at most a quarter away from one, in
      // each of two pictures of different scale.
      EXPECT_NEAR(agreements[i].Residual, DenseResidual(views, rays[i]), 0.5) << i;
    }
  }
}

TEST(HullConsistency, RaysOfAConsistentSetMeetTheHull)
{
  const std::vector<Photo> photos = BoxPhotos();
  const std::vector<View> views = ViewsOf(photos);
  for (const RayConsistency& ray : FollowSilhouetteRays(views, RaysOf(views, 60, true)))
  {
    // Contours are right to a tenth of a pixel, sampling costs a quarter.
    EXPECT_GT(ray.Residual, -0.4);
    // The box reaches 0.6 from the origin; its hull of twelve views a little further.
    EXPECT_LT(ray.Point.norm(), 0.75);
  }
}

TEST(HullConsistency, WithoutAViewIsWhatTheOthersSayAlone)
{
  std::vector<Photo> photos = BoxPhotos();
  ShrinkSilhouette(photos[4], 5);
  const std::vector<View> views = ViewsOf(photos);
  HullConsistencyOptions options;
  options.WithoutEach = true;
  const auto rays = ContourRays(views, 0, 40);
  const auto all = FollowSilhouetteRays(views, rays, options);
  std::vector<View> others = views;
  others.erase(others.begin() + 4);
  const auto alone = FollowSilhouetteRays(others, rays);
  int freed = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    // The two sample their rays at other points, half a pixel apart.
    EXPECT_NEAR(all[i].Without[4], alone[i].Residual, 0.5) << i;
    EXPECT_GE(all[i].Without[4], all[i].Residual);
    freed += all[i].Residual < -1 && all[i].Without[4] > -1;
  }
  // The shrunk silhouette faces view 0 obliquely: it cuts its left or right, and all of top and
  // bottom, which is far more than a tenth.
  EXPECT_GT(freed, 4);
}

TEST(HullConsistency, CamerasThatLookAwaySeeNoHull)
{
  std::vector<Photo> photos = BoxPhotos();
  for (Photo& photo : photos)
  {
    photo.Cam.R = Eigen::DiagonalMatrix<double, 3>(-1, 1, -1) * photo.Cam.R;
    photo.Cam.T = -photo.Cam.R * photo.Cam.Centre();
  }
  std::vector<View> views = ViewsOf(photos);
  for (View& view : views)
  {
    // About their own centres, so that all look outwards.
    view.Cam = LookAt(view.Cam.Centre(), 2 * view.Cam.Centre(), Vector3d::UnitY(), view.Cam.K,
      view.Cam.Width, view.Cam.Height);
  }
  for (const RayConsistency& ray : FollowSilhouetteRays(views, RaysOf(views, 20, false)))
  {
    EXPECT_EQ(ray.Residual, -16);
  }
}

TEST(HullConsistency, WhatLeavesAFrameIsUnknownThereAndNowhereElse)
{
  std::vector<Photo> photos = BoxPhotos();
  // The lower half of one picture is cut off: the object goes on below its frame.
  Photo& cut = photos[3];
  cut.Cam.Height = 60;
  Image<std::uint8_t> mask(160, 60);
  std::copy_n(cut.Mask.Values.begin(), mask.Values.size(), mask.Values.begin());
  cut.Mask = mask;
  cut.ContourDistance = SignedContourDistance(std::as_const(cut.Mask).Ref());
  std::vector<View> views = ViewsOf(photos);
  for (const RayConsistency& ray : FollowSilhouetteRays(views, RaysOf(views, 40, false)))
  {
    EXPECT_GT(ray.Residual, -0.5);
  }
  // A silhouette that ends above the frame's border says that there is nothing below.
  for (int y = 50; y < 60; ++y)
  {
    std::fill_n(cut.Mask.Values.begin() + y * 160, 160, std::uint8_t(0));
  }
  cut.ContourDistance = SignedContourDistance(std::as_const(cut.Mask).Ref());
  views = ViewsOf(photos);
  int against = 0;
  for (const RayConsistency& ray : FollowSilhouetteRays(views, AreaRays(views, 0, 100)))
  {
    against += ray.Residual < -1;
  }
  // More than the lower half of the box is carved away.
  EXPECT_GT(against, 40);
}

TEST(HullConsistency, SameBitsHoweverTheRaysAreSplit)
{
  const std::vector<Photo> photos = BoxPhotos();
  const std::vector<View> views = ViewsOf(photos);
  HullConsistencyOptions options;
  options.WithoutEach = true;
  Execution threads;
  threads.ParallelFor = [](std::int64_t count, const Execution::RangeBody& body)
  {
    std::thread first([&] { body(0, count / 3); });
    body(count / 3, count);
    first.join();
  };
  const auto rays = RaysOf(views, 10, true);
  const auto one = FollowSilhouetteRays(views, rays, options);
  const auto two = FollowSilhouetteRays(views, rays, options, threads);
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    EXPECT_EQ(one[i].Residual, two[i].Residual);
    EXPECT_EQ(one[i].Without, two[i].Without);
    EXPECT_EQ(one[i].Point, two[i].Point);
  }
}

TEST(HullConsistency, RaysLieWhereTheyShould)
{
  const std::vector<Photo> photos{ BoxPhotos().front() };
  const std::vector<View> views = ViewsOf(photos);
  const auto area = AreaRays(views, 0, 50);
  EXPECT_EQ(area.size(), 50u);
  for (const SilhouetteRay& ray : area)
  {
    EXPECT_TRUE(
      views[0].IsObject(static_cast<int>(ray.Pixel.x()), static_cast<int>(ray.Pixel.y())));
  }
  for (const SilhouetteRay& ray : ContourRays(views, 0, 50))
  {
    // Straight edges seen by 16 samples per pixel: an eighth of a pixel, and corners are cut.
    EXPECT_NEAR(SampleBilinear(views[0].ContourDistance, ray.Pixel.x(), ray.Pixel.y()), 0, 0.3);
  }
}

TEST(HullConsistency, AStopIsHeardAmongTheRays)
{
  const std::vector<Photo> photos = BoxPhotos();
  const std::vector<View> views = ViewsOf(photos);
  Execution execution;
  execution.StopRequested = [] { return true; };
  EXPECT_THROW(FollowSilhouetteRays(views, RaysOf(views, 8, false), {}, execution), Interrupted);
}

TEST(HullConsistency, APartBesideTheFrameWasHeldAgainstTheViewThatItLeaves)
{
  const std::vector<Photo> photos = TowerPhotos();
  const std::vector<View> views = ViewsOf(photos);
  const auto rays = RaysOf(views, 100, false);
  const auto agreements = FollowSilhouetteRays(views, rays);
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    EXPECT_GT(agreements[i].Residual, -1) << views[rays[i].ViewId].Name;
  }
}
