// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/PoseCheck.h"

#include "base/Console.h"
#include "base/NumberText.h"
#include "core/Error.h"
#include "core/Quantile.h"
#include "dataset/PhotographSize.h"
#include "synthesis/RefinedCameras.h"

#include <algorithm>
#include <numeric>

namespace novelview
{
namespace
{
constexpr int LongerSidePx = 800; ///< shifts of a pixel show at this size, too
constexpr double LeastShiftPx = 1.4;
constexpr double TimesTheOthers = 3;

bool SilhouettesAgree(const CheckReport& report)
{
  return report.MeanIou >= Agreeing &&
    std::none_of(report.Findings.begin(), report.Findings.end(),
      [](const CheckFinding& finding) { return finding.Severity == CheckSeverity::Error; }) &&
    std::none_of(report.Agreement.begin(), report.Agreement.end(),
      [](const CheckedCamera& camera) { return camera.Outlier; });
}

/** The shift of every camera in pixels of its photograph; empty when none is better. */
std::vector<double> ShiftsOf(const CheckContext& context)
{
  DatasetIndex index;
  index.Cameras = context.Report.Cameras;
  LimitSize(index, {}, LongerSidePx);
  DatasetOptions options;
  options.ForceSilhouettes = context.Input.ForceSilhouettes;
  options.Silhouette = context.Input.Silhouette;
  const Dataset dataset = ReadDataset(index, options);
  SynthesisListener listener;
  listener.Progress = [](const std::string&, double) { return !Console::Interrupted(); };
  const RefinedCameras refined = RefineCamerasOf(dataset.Views, listener);
  if (!refined.Accepted)
  {
    return {};
  }
  std::vector<double> shifts = refined.ShiftsPx;
  for (std::size_t i = 0; i < shifts.size(); ++i)
  {
    shifts[i] *=
      static_cast<double>(context.Report.Cameras[i].Cam.Width) / index.Cameras[i].Cam.Width;
  }
  return shifts;
}
}

void CheckPoses(CheckContext& context)
{
  if (!SilhouettesAgree(context.Report))
  {
    return; // what is wrong otherwise would be taken for wrong poses
  }
  std::vector<double> shifts;
  try
  {
    shifts = ShiftsOf(context);
  }
  catch (const Interrupted&)
  {
    throw;
  }
  catch (const Error& error)
  {
    context.Add(CheckSeverity::Note, "poses", "",
      std::string("whether photographs agree better with other poses cannot be told: ") +
        error.what());
    return;
  }
  if (shifts.empty())
  {
    return;
  }
  const double median = Quantile(shifts, 0.5);
  for (std::size_t i = 0; i < shifts.size(); ++i)
  {
    if (shifts[i] >= std::max(LeastShiftPx, TimesTheOthers * median))
    {
      context.Add(CheckSeverity::Warning, "pose", context.Report.Cameras[i].Name,
        Formatted("the camera is about %.1f px off from where the photographs agree", shifts[i]) +
          Formatted(
            " (median of all: %.1f px); `run` corrects that, `convert --refine-cameras` ", median) +
          "writes it");
    }
  }
  const double mean =
    std::accumulate(shifts.begin(), shifts.end(), 0.0) / static_cast<double>(shifts.size());
  context.Add(CheckSeverity::Note, "poses", "",
    Formatted("photographs agree better with other poses: %.1f px in the mean, ", mean) +
      Formatted("%.1f px at most; `run` uses them, `convert --refine-cameras` writes them",
        *std::max_element(shifts.begin(), shifts.end())));
}
}
