// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SceneRunner_h
#define novelview_SceneRunner_h

#include "synthesis/Synthesis.h"
#include "synthesis/SynthesisStages.h"

#include <string>
#include <vector>

namespace novelview
{
/**
 * Runs the stages that do not depend on the novel camera, and reports what they changed or left out.
 * Stages that have run are not run again.
 */
class SceneRunner
{
public:
  SceneRunner(
    SynthesisStages& filters, const SynthesisOptions& options, const SynthesisListener& listener)
    : Filters(filters)
    , Options(options)
    , Listener(listener)
  {
  }

  void MakeHull();
  void MakeHullAndCrust();
  void MakeAll();
  /** The CameraRefiner and the stages that it needs, with the given cameras. */
  void RefineCameras();

  void Warn(const std::string& text);
  /** All warnings so far. */
  const std::vector<std::string>& GetWarnings() const { return this->Warnings; }

private:
  bool RefinesCameras();
  void RunScene();
  void RunHull();
  void RunCrust();
  void RunCrustAndDepths();
  void Run(const std::string& stage, vtkAlgorithm* filter);
  void UseRefinedCameras();
  void UseRepairedSilhouettes();
  void WarnOfHull();
  void WarnOfOffsets();
  void WarnOfGains();

  SynthesisStages& Filters;
  const SynthesisOptions& Options;
  const SynthesisListener& Listener;
  vtkNew<vtkPolyData> HullOfCrust; ///< the Mesher's input
  std::vector<std::string> Warnings;
  bool WarnedOfHull = false;
  bool TriedRepair = false;
  bool TriedCameras = false; ///< whether the cameras are as good as they get
};
}

#endif
