// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/OrientationCheck.h"

#include "base/NumberText.h"
#include "base/Parallel.h"
#include "check/AgreementSurvey.h"
#include "check/CheckedSilhouettes.h"

#include <algorithm>

namespace novelview
{
namespace
{
/** Hull IoU of the silhouettes that photographs read like this have. */
double AgreementOf(const CheckContext& context, std::vector<Photograph> cameras)
{
  constexpr int sizePx = 320;
  constexpr int rays = 60;
  std::vector<CheckedPhotograph> photographs(cameras.size());
  ParallelForEach(cameras.size(),
    [&](std::size_t i)
    {
      photographs[i] =
        InspectPhotograph(cameras[i], context.Input.ForceSilhouettes, context.Input.Silhouette);
    });
  std::vector<FoundMask> masks;
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    masks.push_back(photographs[i].Mask);
    cameras[i].Cam.Width = std::max(photographs[i].Width, 1);
    cameras[i].Cam.Height = std::max(photographs[i].Height, 1);
  }
  const CheckedSilhouettes silhouettes(cameras, masks, context.Invert, sizePx);
  return SurveyAgreement(silhouettes.ViewsOf(cameras, silhouettes.Ids()), rays, context.Quiet)
    .MeanIou;
}
}

void CheckOrientation(CheckContext& context)
{
  constexpr double clearGain = 0.05; // of hull IoU
  const auto& notes = context.Index.Notes;
  const bool open = std::any_of(notes.begin(), notes.end(),
    [](const ReadingNote& note) { return note.Kind == "exif-orientation" && note.Harmful; });
  if (!open)
  {
    return;
  }
  DatasetSource source = context.Input.Source;
  source.ExifOrientation = "apply";
  const DatasetIndex applied = ReadDatasetIndex(context.Input.Dataset, source);
  const double now = AgreementOf(context, WithoutExcluded(context.Index, context.Input.Exclude));
  const double then = AgreementOf(context, WithoutExcluded(applied, context.Input.Exclude));
  if (then > now + clearGain)
  {
    CheckFinding finding{ CheckSeverity::Error, "exif-orientation", "",
      "the silhouettes agree only when the EXIF orientation tags are applied: hull IoU " +
        Formatted("%.2f instead of ", then) + Formatted("%.2f", now),
      { "--exif-orientation", "apply" }, {} };
    context.Report.Findings.push_back(finding);
  }
}
}
