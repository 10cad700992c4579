// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_StageRunner_h
#define novelview_StageRunner_h

#include <functional>
#include <string>

class vtkAlgorithm;

namespace novelview
{
/** Receives the progress of a stage, 0 to 1; returns false to request a stop. */
using StageProgress = std::function<bool(const std::string& stage, double fraction)>;
/** Called when a stage has ended, with its duration in seconds. */
using StageDone = std::function<void(const std::string& stage, double seconds)>;

/**
 * Updates a filter (all its output ports) and turns its errors into an exception: in VTK 9.1
 * Update() returns nothing, so the ErrorEvents of the filter and of its executive are observed.
 *
 * Throws Error "STAGE: text" with the filter's own text, or Interrupted when `progress` requested a
 * stop.
 */
void RunStage(const std::string& stage, vtkAlgorithm* filter, const StageProgress& progress = {},
  const StageDone& done = {});

struct StageRun
{
  std::string Stage;
  vtkAlgorithm* Filter;
};

/**
 * RunStage() for two filters at the same time: the first one in this thread, the second in another;
 * with one thread (LimitThreads) the second and then the first. They must not share a filter before
 * them. `progress` is called in this thread, with all of the first one's and with the second's at
 * least once, when it begins, and while only that is left; a requested stop stops both. When both
 * have ended well, `done` is called for the one that ended earlier and then for the other.
 *
 * When the first one fails its error is thrown, and the second is stopped. Returns how many seconds
 * less they took than the sum of both.
 */
double RunStagesTogether(const StageRun& first, const StageRun& second,
  const StageProgress& progress = {}, const StageDone& done = {});
}

#endif
