// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CameraTrajectory_h
#define novelview_CameraTrajectory_h

#include "dataset/Dataset.h"
#include "geometry/Camera.h"

#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/** Where the camera of a video goes. */
struct TrajectoryOptions
{
  std::filesystem::path Path; ///< file of key cameras; empty = round the cameras' ring
  int Frames = 0;             ///< 0 = as stated by the path, else 72
  double Fps = 24;            ///< frames per second
};

/**
 * The cameras of the frames of a video, as `novelview orbit` makes them.
 *
 * Without options.Path: once round the ring that the data set's cameras are on (FitCameraRing), but
 * for photographs in `exclude`, from the first camera towards the second, without coming back to
 * the first frame. Cameras that are not on a ring are a UsageError that names --path.
 *
 * With options.Path: a JSON file, in the project's convention (Camera.h), with
 *
 *     "keys"    two or more key cameras, in order; each is one of
 *                 { "camera": NAME or number from 0 }         of the data set
 *                 { "K": [9], "R": [9], "t": [3] }            row by row, flat or nested
 *                 { "position": [3], "lookAt": [3], "up": [3] }  up: the cameras' mean if not given
 *               and may have "K" or "fieldOfView" (vertical, degrees); else K is that of the
 *               camera, or of the data set's first
 *               and "frame" (whole number) or "time" (seconds): all keys the same of the two, or
 *               none: then they are evenly spread
 *     "closed"  true: the video returns to the first key and can be played in a loop
 *     "size"    "640x480"; that of the data set's first photograph when not given
 *
 * The number of frames is options.Frames; when that is 0, what the keys' frames or times (at
 * options.Fps) say, and 72 otherwise. Throws UsageError, naming the file and the key.
 */
std::vector<Camera> CamerasOfFrames(const TrajectoryOptions& options, const DatasetIndex& dataset,
  const std::vector<std::string>& exclude = {});
}

#endif
