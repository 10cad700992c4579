// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis/SceneRunner.h"

#include "ViewAccess.h"
#include "base/NumberText.h"
#include "synthesis/StageRunner.h"

#include <algorithm>
#include <utility>

#include <malloc.h>

namespace novelview
{
namespace
{
std::string Pixels(double length)
{
  return Formatted("%.1f px", length);
}
}

void SceneRunner::MakeHull()
{
  this->RefinesCameras() ? this->RunScene() : this->RunHull();
  this->WarnOfHull();
}

void SceneRunner::MakeHullAndCrust()
{
  this->RefinesCameras() ? this->RunScene() : this->RunCrust();
  this->WarnOfHull();
}

void SceneRunner::MakeAll()
{
  this->RunScene();
  this->WarnOfHull();
  this->WarnOfGains();
}

void SceneRunner::RefineCameras()
{
  this->RunHull();
  this->Run("depth maps", this->Filters.DepthEstimator);
  this->Run("cameras", this->Filters.CameraRefiner);
}

void SceneRunner::Warn(const std::string& text)
{
  this->Warnings.push_back(text);
  if (this->Listener.Warn)
  {
    this->Listener.Warn(text);
  }
}

/** Refined cameras change all that comes before them, too. */
bool SceneRunner::RefinesCameras()
{
  return this->Filters.CameraRefiner->GetNumberOfInputConnections(0) > 0;
}

/** Every stage before the novel camera; with better cameras, if there are, all of them again. */
void SceneRunner::RunScene()
{
  this->Options.UseDepthMaps ? this->RunCrustAndDepths() : this->RunCrust();
  if (this->RefinesCameras() && !std::exchange(this->TriedCameras, true))
  {
    this->Run("cameras", this->Filters.CameraRefiner);
    if (this->Filters.CameraRefiner->GetRefined())
    {
      this->UseRefinedCameras();
      this->RunCrustAndDepths();
    }
  }
}

void SceneRunner::RunHull()
{
  if (this->Options.ReconcileSilhouettes)
  {
    this->Run("silhouettes", this->Filters.Reconciler);
  }
  this->Run("visual hull", this->Filters.HullSource);
  // What a box cuts off is not missing in a silhouette.
  const bool cut = this->Filters.HullSource->GetCutByBox();
  if (this->Options.RepairSilhouettes && !std::exchange(this->TriedRepair, true) && !cut)
  {
    this->Run("silhouettes", this->Filters.Repairer);
    if (this->Filters.Repairer->GetRepaired())
    {
      this->UseRepairedSilhouettes();
      this->Run("visual hull", this->Filters.HullSource);
    }
  }
  vtkPolyData* hull = this->Filters.HullSource->GetOutput();
  if (hull->GetMTime() > this->HullOfCrust->GetMTime())
  {
    // By hand, since pipelines that run at the same time must have no filter in common.
    this->HullOfCrust->ShallowCopy(hull);
    this->Filters.Mesher->SetInputData(this->HullOfCrust);
  }
}

void SceneRunner::RunCrust()
{
  this->RunHull();
  this->Run("power crust", this->Filters.Mesher);
}

/** Neither needs the other, and the crust keeps few threads busy. */
void SceneRunner::RunCrustAndDepths()
{
  this->RunHull();
  const double saved = RunStagesTogether({ "depth maps", this->Filters.DepthEstimator },
    { "power crust", this->Filters.Mesher }, this->Listener.Progress, this->Listener.StageDone);
  if (this->Listener.StagesOverlapped && saved > 0)
  {
    this->Listener.StagesOverlapped(saved);
  }
  // Both leave much memory free between what they keep; what follows needs other sizes.
  malloc_trim(0);
}

void SceneRunner::Run(const std::string& stage, vtkAlgorithm* filter)
{
  RunStage(stage, filter, this->Listener.Progress, this->Listener.StageDone);
}

void SceneRunner::UseRefinedCameras()
{
  vtkCameraRefiner* refiner = this->Filters.CameraRefiner;
  vtkNew<vtkMultiBlockDataSet> views;
  views->ShallowCopy(refiner->GetOutput());
  double largest = 0;
  std::string where;
  for (unsigned int viewId = 0; viewId < views->GetNumberOfBlocks(); ++viewId)
  {
    const double shift = AttachedNumber(ViewImage(views, viewId), arrays::CameraShift, 0);
    if (shift > largest)
    {
      largest = shift;
      where = ViewName(views, viewId);
    }
  }
  this->Warn(
    Formatted("cameras refined: photographs disagreed by %.2f px", refiner->GetErrorBefore()) +
    Formatted(", now by %.2f px", refiner->GetErrorAfter()) +
    Formatted("; largest shift %.2f px (", largest) + where +
    "); --no-refine-cameras keeps the given ones");
  this->Filters.Views->SetOutput(views);
}

/** They stand in the place of the given ones from here on. */
void SceneRunner::UseRepairedSilhouettes()
{
  vtkNew<vtkMultiBlockDataSet> views;
  views->ShallowCopy(this->Filters.Repairer->GetOutput());
  std::vector<std::string> names;
  for (unsigned int viewId = 0; viewId < views->GetNumberOfBlocks(); ++viewId)
  {
    const double added = AttachedNumber(ViewImage(views, viewId), arrays::AddedPixels, 0);
    if (added > 0)
    {
      names.push_back(ViewName(views, viewId) + Formatted(" %.0f px", added));
    }
  }
  this->Warn("silhouettes: parts added that most others show: " + Joined(names) +
    "; --no-repair-silhouettes leaves them out");
  this->Filters.Views->SetOutput(views);
}

/** Reports once what was done to the silhouettes, and components that were left out. */
void SceneRunner::WarnOfHull()
{
  if (std::exchange(this->WarnedOfHull, true))
  {
    return;
  }
  if (this->Options.ReconcileSilhouettes)
  {
    this->WarnOfOffsets();
  }
  if (this->Filters.HullSource->GetCutByBox())
  {
    this->Warn("visual hull: cut at the box of --hull-box" +
      std::string(this->Options.RepairSilhouettes ? "; silhouettes are not repaired" : ""));
  }
  if (const int dropped = this->Filters.HullSource->GetNumberOfDroppedComponents(); dropped > 0)
  {
    this->Warn("visual hull: " + std::to_string(dropped) + " smaller component(s) with " +
      std::to_string(this->Filters.HullSource->GetNumberOfDroppedSamples()) +
      " samples left out; --hull-keep-all keeps them");
  }
}

/** Reports every silhouette that was enlarged. */
void SceneRunner::WarnOfOffsets()
{
  vtkMultiBlockDataSet* views = this->Filters.Reconciler->GetOutput();
  std::vector<double> offsets;
  for (unsigned int viewId = 0; viewId < views->GetNumberOfBlocks(); ++viewId)
  {
    offsets.push_back(AttachedNumber(ViewImage(views, viewId), arrays::ContourOffset, 0));
  }
  const double common = *std::min_element(offsets.begin(), offsets.end());
  if (common > 0)
  {
    this->Warn(
      "silhouettes and cameras disagree; every silhouette is enlarged by " + Pixels(common));
  }
  for (unsigned int viewId = 0; viewId < offsets.size(); ++viewId)
  {
    if (offsets[viewId] > common)
    {
      this->Warn("silhouette of " + ViewName(views, viewId) + ": " +
        Pixels(offsets[viewId] - common) + " smaller than the others allow; enlarged by that");
    }
  }
}

/** Reports photographs that are brought to one exposure. */
void SceneRunner::WarnOfGains()
{
  if (!this->Options.UseDepthMaps || !this->Options.Texture.UseGains)
  {
    return;
  }
  vtkMultiBlockDataSet* views = this->Filters.DepthEstimator->GetOutput();
  double least = 1;
  double most = 1;
  for (unsigned int viewId = 0; viewId < views->GetNumberOfBlocks(); ++viewId)
  {
    const double gain = AttachedNumber(ViewImage(views, viewId), arrays::ExposureGain, 1);
    least = std::min(least, gain);
    most = std::max(most, gain);
  }
  if (least < most)
  {
    this->Warn("exposures differ by up to " + Formatted("%.0f %%", 100 * (most / least - 1)) +
      "; photographs are brought to their mean; --no-exposure-gains keeps them as they are");
  }
}
}
