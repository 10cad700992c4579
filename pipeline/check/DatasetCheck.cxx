// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/DatasetCheck.h"

#include "check/AgreementCheck.h"
#include "check/CameraCheck.h"
#include "check/CheckContext.h"
#include "check/ConventionCheck.h"
#include "check/ExposureCheck.h"
#include "check/FileCheck.h"
#include "check/MaskCheck.h"
#include "check/OrientationCheck.h"
#include "check/PixelCentreCheck.h"
#include "check/PoseCheck.h"
#include "core/Error.h"
#include "dataset/PhotographSize.h"

#include <algorithm>
#include <utility>

namespace novelview
{
namespace
{
void ReadPhotographs(CheckContext& context, const Execution& execution)
{
  context.Index = ReadDatasetIndex(context.Input.Dataset, context.Input.Source);
  context.Report.Folder = context.Index.Folder;
  context.Report.Calibration = context.Index.Calibration;
  context.Report.Format = context.Index.Format;
  execution.Report(0);
  context.Inspect(WithoutExcluded(context.Index, context.Input.Exclude));
  context.TakeCameras(context.Index);
  for (const CheckedPhotograph& photograph : context.Report.Photographs)
  {
    context.Masks.push_back(photograph.Mask);
  }
  execution.Report(0.2);
}

/** Whether `run` reduces the photographs, and those that can be read have one size per K. */
void CheckSizes(CheckContext& context)
{
  DatasetIndex readable;
  for (std::size_t i = 0; i < context.Report.Cameras.size(); ++i)
  {
    if (context.Report.Photographs[i].Width > 0)
    {
      readable.Cameras.push_back(context.Report.Cameras[i]);
    }
  }
  try
  {
    if (!readable.Cameras.empty())
    {
      LimitSize(readable, {}, context.Input.MaxSize);
    }
  }
  catch (const Error& error)
  {
    context.Add(CheckSeverity::Error, "size", "", error.what());
  }
  for (const ReadingNote& note : readable.Notes)
  {
    context.Add(CheckSeverity::Note, note.Kind, "", note.Text);
  }
}

/** What reading ignored, guessed or changed. */
void CheckReading(CheckContext& context)
{
  for (const ReadingNote& note : context.Index.Notes)
  {
    context.Add(
      note.Harmful ? CheckSeverity::Warning : CheckSeverity::Note, note.Kind, "", note.Text);
  }
}
}

CheckReport CheckDataset(const DatasetInput& input, const Execution& execution)
{
  CheckContext context(input, execution);
  ReadPhotographs(context, execution);
  CheckConvention(context);
  execution.Report(0.6);
  CheckReading(context);
  CheckSizes(context);
  CheckOrientation(context);
  CheckFiles(context);
  CheckMasks(context);
  CheckExposure(context);
  CheckCameras(context);
  CheckAgreement(context);
  execution.Report(0.9);
  CheckPixelCentre(context);
  CheckPoses(context);
  std::stable_sort(context.Report.Findings.begin(), context.Report.Findings.end(),
    [](const CheckFinding& a, const CheckFinding& b) { return a.Severity > b.Severity; });
  execution.Report(1);
  return std::move(context.Report);
}
}
