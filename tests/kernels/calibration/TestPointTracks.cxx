// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/PointTracks.h"
#include "core/Quantile.h"
#include "support/CalibrationScene.h"

#include <gtest/gtest.h>

#include <set>

using namespace novelview;
using namespace support;

namespace
{
/** Distances of what was found from where the true cameras show the point. */
std::vector<double> ErrorsOf(const std::vector<PointTrack>& tracks, const CalibrationScene& scene)
{
  std::vector<double> errors;
  for (const PointTrack& track : tracks)
  {
    const PointObservation& first = track.Observations.front();
    const double depth = scene.Photos[first.View].TrueDepth(
      static_cast<int>(first.Pixel.x()), static_cast<int>(first.Pixel.y()));
    const Vector3d point = scene.True[first.View].Unproject(first.Pixel, depth);
    for (std::size_t i = 1; i < track.Observations.size(); ++i)
    {
      const PointObservation& other = track.Observations[i];
      errors.push_back((scene.True[other.View].Project(point) - other.Pixel).norm());
    }
  }
  return errors;
}
}

TEST(PointTracks, AreWhereThePhotographShowsThePoint)
{
  const CalibrationScene scene(Waves(0.06));
  const auto tracks = FindPointTracks(scene.Views());
  ASSERT_GT(tracks.size(), 200u);
  EXPECT_LT(Quantile(ErrorsOf(tracks, scene), 0.5), 0.2);
  std::set<int> first;
  for (const PointTrack& track : tracks)
  {
    ASSERT_GE(track.Observations.size(), 2u);
    first.insert(track.Observations.front().View);
    EXPECT_NEAR(track.Position.norm(), 0.5, 0.02);
  }
  EXPECT_EQ(first.size(), scene.Photos.size()) << "every photograph is a reference";
}

TEST(PointTracks, WrongCamerasDoNotMoveThem)
{
  CalibrationScene scene(Waves(0.06));
  scene.Disturb(1);
  const auto tracks = FindPointTracks(scene.Views());
  ASSERT_GT(tracks.size(), 200u);
  EXPECT_LT(Quantile(ErrorsOf(tracks, scene), 0.5), 0.2);
}

TEST(PointTracks, NothingIsFoundWithoutTexture)
{
  EXPECT_TRUE(FindPointTracks(CalibrationScene(Plain(120, 120, 120)).Views()).empty());
}

TEST(PointTracks, NothingIsFoundWithoutDepth)
{
  CalibrationScene scene(Waves(0.06));
  for (Photo& photo : scene.Photos)
  {
    std::fill(photo.TrueDepth.Values.begin(), photo.TrueDepth.Values.end(), 0.f);
  }
  EXPECT_TRUE(FindPointTracks(scene.Views()).empty());
}
