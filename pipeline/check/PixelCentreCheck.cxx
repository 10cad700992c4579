// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/PixelCentreCheck.h"

#include "base/NumberText.h"
#include "check/SuggestedCommand.h"

#include <vector>

namespace novelview
{
void CheckPixelCentre(CheckContext& context)
{
  const CheckedSilhouettes silhouettes(context.Report.Cameras, context.Masks, context.Invert);
  if (context.Report.MeanIouAfter || context.Report.MeanIou < Agreeing ||
    silhouettes.Ids().size() < 4)
  {
    return;
  }
  const double now = *context.Convention.PixelCentre;
  const double other = 0.5 - now;
  const double reduction = silhouettes.ReductionOf(silhouettes.Ids().front());
  const double shift = (now - other) / reduction;
  const PixelCentreVerdict verdict =
    ComparePixelCentres(silhouettes.ViewsOf(context.Report.Cameras, silhouettes.Ids()),
      { 0, shift, 2 * shift, -shift }, context.Quiet);
  context.Report.PixelCentre = verdict;
  const std::vector<double>& loss = verdict.LossPx;
  if (loss[1] < 0.5 * loss[0] && loss[1] < 0.5 * loss[2] && loss[0] < loss[3] && verdict.Sigmas > 5)
  {
    const CameraConvention own = OwnConvention(context.Input.Dataset, context.Input.Source);
    CameraConvention wanted = context.Convention;
    wanted.PixelCentre = other;
    CheckFinding finding{ CheckSeverity::Warning, "pixel-centre", "", "", {}, {} };
    finding.Options = ConventionOptions(own, wanted);
    finding.Text = "the contours agree clearly better with the top-left pixel's centre at " +
      NumberText(other) + ": they miss each other by " +
      Formatted("%.3f px instead of ", loss[1] * reduction) +
      Formatted("%.3f px", loss[0] * reduction);
    finding.Command = ConvertCommand(context.Input, context.Report.Format, finding.Options);
    context.Report.Findings.push_back(finding);
  }
}
}
