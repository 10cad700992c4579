// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/ConventionCheck.h"

#include "base/NumberText.h"
#include "check/ConventionTrials.h"
#include "check/SuggestedCommand.h"
#include "core/Quantile.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace novelview
{
namespace
{
constexpr double ClearGain = 0.15; ///< of hull IoU

/** Whether silhouettes that agree so well show that others, which agree as now, are read wrong. */
bool ClearlyBetter(double best, double now)
{
  // Either much is gained, or most of what is missing.
  return best >= Convincing &&
    (best - now >= ClearGain || (best - now >= ClearGain / 3 && 1 - best <= (1 - now) / 4));
}

/** Whether most silhouettes are what surrounds an object. */
bool LooksInverted(const CheckContext& context, bool invert)
{
  const CheckedSilhouettes silhouettes(context.Report.Cameras, context.Masks, invert, 160);
  std::vector<double> shares;
  for (const int id : silhouettes.Ids())
  {
    shares.push_back(silhouettes.BorderShareOf(id));
  }
  return Quantile(shares, 0.5) > 0.5;
}

void ReportConvention(
  CheckContext& context, const CameraConvention& own, const ConventionTrial& chosen)
{
  CheckFinding finding;
  finding.Severity = CheckSeverity::Error;
  finding.Kind = context.Report.ChosenTrial == 0 ? "mask-polarity" : "convention";
  finding.Options = ConventionOptions(own, context.Convention);
  std::vector<std::string> changes = chosen.Changes;
  if (context.Report.MasksInverted)
  {
    changes.push_back("mask polarity");
  }
  const std::string way = finding.Options.empty() ? "without the options that change how it is read"
                                                  : "with " + Joined(finding.Options, " ");
  finding.Text = "the silhouettes agree only when read " + way + " (" + Joined(changes, " and ") +
    "): hull IoU " +
    (context.Report.MasksInverted && context.Report.ChosenTrial == 0
        ? std::string("")
        : Formatted("%.2f instead of ", chosen.Iou) +
          Formatted("%.2f", context.Report.Trials.front().Iou));
  if (context.Report.MasksInverted && context.Report.ChosenTrial == 0)
  {
    finding.Text += Formatted("%.2f; as read, the object is what surrounds it", chosen.Iou);
  }
  finding.Command = ConvertCommand(context.Input, context.Report.Format, finding.Options);
  context.Report.Findings.push_back(finding);
}

/** Reads the data set in the convention that was found, and reports it when it is another one. */
void ApplyConvention(CheckContext& context, const CameraConvention& own)
{
  const ConventionTrial& chosen = context.Report.Trials[context.Report.ChosenTrial];
  context.Convention = chosen.Convention;
  context.Convention.InvertMasks = context.Invert;
  if (context.Report.ChosenTrial == 0 && !context.Report.MasksInverted)
  {
    return;
  }
  const DatasetSource source = SourceReadAs(context.Input.Source, own, context.Convention);
  context.Index = ReadDatasetIndex(context.Input.Dataset, source);
  if (context.Report.MasksInverted)
  {
    context.Inspect(WithoutExcluded(context.Index, context.Input.Exclude));
  }
  context.TakeCameras(context.Index);
  ReportConvention(context, own, chosen);
}
}

void CheckConvention(CheckContext& context)
{
  const CameraConvention own = OwnConvention(context.Input.Dataset, context.Input.Source);
  const CameraConvention now = Override(own, context.Input.Source.Convention);
  context.Invert = now.InvertMasks;
  const auto tried = [&](bool invert)
  {
    return TryConventions(context.Input.Dataset, context.Input.Source, context.Input.Exclude,
      context.Masks, invert, context.Quiet);
  };
  const bool given = std::any_of(context.Masks.begin(), context.Masks.end(),
    [](const FoundMask& mask) { return mask.Source != MaskSource::Extracted; });
  if (given && LooksInverted(context, context.Invert))
  {
    auto trials = tried(!context.Invert);
    const std::size_t best = ChooseTrial(trials);
    if (trials[best].Iou >= Convincing)
    {
      context.Report.MasksInverted = true;
      context.Invert = !context.Invert;
      context.Report.Trials = std::move(trials);
      context.Report.ChosenTrial = static_cast<int>(best);
    }
  }
  if (!context.Report.MasksInverted)
  {
    context.Report.Trials = tried(context.Invert);
    const std::size_t best = ChooseTrial(context.Report.Trials);
    const bool convincing =
      ClearlyBetter(context.Report.Trials[best].Iou, context.Report.Trials[0].Iou);
    context.Report.ChosenTrial = convincing ? static_cast<int>(best) : 0;
  }
  ApplyConvention(context, own);
}
}
