// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/CameraCheck.h"

#include "check/CameraAnomalies.h"
#include "images/Metrics.h"

#include <cstddef>
#include <vector>

namespace novelview
{
namespace
{
/** Whether two photographs have the same silhouette, so that one camera for both may be right. */
bool ShowTheSame(const CheckContext& context, int a, int b)
{
  return MaskIou(context.Masks[a].Pixels, context.Masks[b].Pixels) > 0.95;
}
}

void CheckCameras(CheckContext& context)
{
  // Of a photograph that cannot be read the size is not known.
  std::vector<Photograph> sized;
  std::vector<int> ids;
  for (std::size_t i = 0; i < context.Report.Cameras.size(); ++i)
  {
    if (context.Report.Photographs[i].Width > 0)
    {
      sized.push_back(context.Report.Cameras[i]);
      ids.push_back(static_cast<int>(i));
    }
  }
  for (const CameraAnomaly& anomaly : FindCameraAnomalies(sized))
  {
    const int id = ids[anomaly.CameraId];
    const bool harmless = anomaly.Kind == "rotation" ||
      (anomaly.Kind == "same-camera" && ShowTheSame(context, id, ids[anomaly.OtherId]));
    context.Add(harmless ? CheckSeverity::Note : CheckSeverity::Warning, anomaly.Kind,
      sized[anomaly.CameraId].Name, anomaly.Text);
  }
}
}
