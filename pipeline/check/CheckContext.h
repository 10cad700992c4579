// SPDX-License-Identifier: GPL-3.0-or-later
/** What the checks of a data set share. */
#ifndef novelview_CheckContext_h
#define novelview_CheckContext_h

#include "check/CheckReport.h"
#include "core/Execution.h"
#include "dataset/DatasetInput.h"

#include <string>
#include <vector>

namespace novelview
{
/** Hull IoU of silhouettes that surely belong together. */
constexpr double Convincing = 0.75;
/** Hull IoU of silhouettes with which nothing is wrong. */
constexpr double Agreeing = 0.9;

/** A data set that is being examined; each check adds to the report. */
struct CheckContext
{
  CheckContext(const DatasetInput& input, const Execution& execution);

  void Add(CheckSeverity severity, const std::string& kind, const std::string& view,
    const std::string& text);

  /** Inspects the photographs of the cameras, with the masks' polarity as these state. */
  void Inspect(const std::vector<Photograph>& cameras);

  /** Takes over the cameras. Those without a size in the calibration take that of the photograph. */
  void TakeCameras(const DatasetIndex& index);

  const DatasetInput& Input;
  Execution Quiet; ///< reports no progress
  DatasetIndex Index;
  std::vector<FoundMask> Masks;
  CameraConvention Convention; ///< found right, complete
  bool Invert = false;
  CheckReport Report;
};
}

#endif
