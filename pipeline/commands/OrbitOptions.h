// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OrbitOptions_h
#define novelview_OrbitOptions_h

#include "commands/MethodOptions.h"
#include "video/CameraTrajectory.h"

#include <filesystem>
#include <string>

namespace novelview
{
/** A video of the object from a moving camera: `novelview orbit`. */
struct OrbitOptions
  : MethodOptions
  , TrajectoryOptions
{
  std::filesystem::path Out;       ///< a video, or a folder for the frames
  std::filesystem::path FramesDir; ///< also gets the frames as images; empty = none
  /** Of several processes; 0 = never. */
  int RankTimeoutSeconds = ProgramParameters::RankTimeoutSeconds.Default;

  /**
   * A video is softer at the silhouette boundary, where the contour would otherwise jump from pixel
   * to pixel.
   */
  static SynthesisOptions DefaultsOf(const std::string& preset);
};

/** The table: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(OrbitOptions& options);

/** See MergeOptions(). Throws UsageError. */
OrbitOptions MakeOrbitOptions(const std::filesystem::path& dataset, const ParsedArguments& given,
  const OptionWarning& warn = {});
}

#endif
