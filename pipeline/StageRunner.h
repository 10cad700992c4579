// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_StageRunner_h
#define novelview_StageRunner_h

#include <functional>
#include <string>

class vtkAlgorithm;

namespace novelview
{
/** Hears how far a stage is, 0 to 1; returns false to ask for a stop. */
using StageProgress = std::function<bool(const std::string& stage, double fraction)>;
/** Hears that a stage has ended, and after how many seconds. */
using StageDone = std::function<void(const std::string& stage, double seconds)>;

/**
 * Updates a filter (all its output ports) and turns its errors into an exception: in VTK 9.1
 * Update() returns nothing, so the ErrorEvents of the filter and of its executive are observed.
 *
 * Throws Error "STAGE: text" with the filter's own text, or Interrupted when `progress` asked for a
 * stop.
 */
void RunStage(const std::string& stage, vtkAlgorithm* filter, const StageProgress& progress = {},
  const StageDone& done = {});
}

#endif
