// SPDX-License-Identifier: GPL-3.0-or-later
/** Which way of reading a calibration the silhouettes agree with. */
#ifndef novelview_ConventionTrials_h
#define novelview_ConventionTrials_h

#include "check/CheckedSilhouettes.h"
#include "core/Execution.h"
#include "dataset/Dataset.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/** One way to read the calibration. */
struct ConventionTrial
{
  CameraConvention Convention;      ///< complete
  std::vector<std::string> Changes; ///< what differs from how it was read, "axes", "poses" ..
  std::vector<std::string> Options; ///< of the command line, that make the program read it so
  bool Readable = true;             ///< false: cameras would be none
  double Iou = 0;                   ///< RobustIou of the silhouettes with these cameras
};

/**
 * Every way to read the calibration with axes, poses, rotation order and y either as `source` says
 * or the other way; masks are inverted in all or none. The first one is as it is read.
 */
std::vector<ConventionTrial> TryConventions(const std::filesystem::path& folder,
  const DatasetSource& source, const std::vector<std::string>& exclude,
  const std::vector<FoundMask>& masks, bool invert, const Execution& execution = {});

/** The best of them: among about equals (0.02 of IoU) the one with the fewest changes. */
std::size_t ChooseTrial(const std::vector<ConventionTrial>& trials);

/** The convention of a calibration without other options. */
CameraConvention OwnConvention(const std::filesystem::path& folder, const DatasetSource& source);

/** The options that make the program read a calibration of convention `own` as `wanted`. */
std::vector<std::string> ConventionOptions(
  const CameraConvention& own, const CameraConvention& wanted);

/** The source that is read as `wanted`. */
DatasetSource SourceReadAs(
  const DatasetSource& source, const CameraConvention& own, const CameraConvention& wanted);
}

#endif
