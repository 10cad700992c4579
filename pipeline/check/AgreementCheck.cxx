// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/AgreementCheck.h"

#include "base/NumberText.h"
#include "check/OutlierSearch.h"
#include "check/SuggestedCommand.h"

#include <algorithm>

namespace novelview
{
namespace
{
/** Hull IoU that silhouettes taken from good photographs reach; real ones have 0.98. */
constexpr double GoodExtraction = 0.96;

/** Says that silhouettes which the program itself took do not agree as such ones can. */
void JudgeExtraction(CheckContext& context, double mean)
{
  const auto& photographs = context.Report.Photographs;
  const auto extracted = std::count_if(photographs.begin(), photographs.end(),
    [](const CheckedPhotograph& each) { return each.Mask.Source == MaskSource::Extracted; });
  if (2 * static_cast<std::size_t>(extracted) > photographs.size() && mean < GoodExtraction)
  {
    context.Add(CheckSeverity::Warning, "extraction", "",
      "the silhouettes taken from the photographs agree to a hull IoU of " +
        Formatted("%.2f", mean) + " only, usual is " + Formatted("%.2f", GoodExtraction) +
        " and more: look at them with novelview mask, and give masks if they are wrong; if they "
        "are right, the cameras are not");
  }
}
}

void CheckAgreement(CheckContext& context)
{
  CheckedSilhouettes silhouettes(context.Report.Cameras, context.Masks, context.Invert);
  OutlierSearch views(
    context.Report.Cameras, silhouettes, context.Masks, context.Input.Silhouette, context.Quiet);
  views.Examine(context.Report.Agreement);
  context.Report.MeanIou = views.MeanIou();
  context.Report.HullPoints = views.HullPoints();
  if (!views.Outliers().empty())
  {
    context.Report.MeanIouAfter = views.MeanIouAfter();
  }
  for (const OutlierView& outlier : views.Outliers())
  {
    // What takes little from the hull can be lived with.
    const bool grave = views.MeanIou() < Agreeing;
    CheckFinding finding{ grave ? CheckSeverity::Error : CheckSeverity::Warning, outlier.Kind,
      context.Report.Cameras[outlier.CameraId].Name, outlier.Text, {}, {} };
    finding.Options = { "--exclude", finding.View };
    finding.Command =
      SuggestedCommand(context.Input, "check", { "--exclude", views.OutlierNames() }, "--format");
    context.Report.Findings.push_back(finding);
  }
  const double mean = views.Outliers().empty() ? views.MeanIou() : views.MeanIouAfter();
  if (silhouettes.Ids().size() >= 2 && mean < Agreeing)
  {
    context.Add(mean < Convincing ? CheckSeverity::Error : CheckSeverity::Warning, "inconsistent",
      "",
      "the silhouettes do not agree (hull IoU " + Formatted("%.2f", mean) +
        "), and neither another convention nor a few single views explain it: cameras or masks "
        "are wrong throughout");
  }
  else if (silhouettes.Ids().size() >= 2)
  {
    JudgeExtraction(context, mean);
  }
}
}
