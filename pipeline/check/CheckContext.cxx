// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/CheckContext.h"

#include "base/Parallel.h"

#include <algorithm>

namespace novelview
{
CheckContext::CheckContext(const DatasetInput& input, const Execution& execution)
  : Input(input)
  , Quiet(execution)
{
  this->Quiet.Progress = [](double) { return true; };
}

void CheckContext::Add(
  CheckSeverity severity, const std::string& kind, const std::string& view, const std::string& text)
{
  this->Report.Findings.push_back({ severity, kind, view, text, {}, {} });
}

void CheckContext::Inspect(const std::vector<Photograph>& cameras)
{
  this->Report.Photographs.assign(cameras.size(), {});
  ParallelForEach(cameras.size(),
    [&](std::size_t i)
    {
      this->Report.Photographs[i] =
        InspectPhotograph(cameras[i], this->Input.ForceSilhouettes, this->Input.Silhouette);
    });
}

void CheckContext::TakeCameras(const DatasetIndex& index)
{
  this->Report.Cameras = WithoutExcluded(index, this->Input.Exclude);
  for (std::size_t i = 0; i < this->Report.Cameras.size(); ++i)
  {
    Camera& camera = this->Report.Cameras[i].Cam;
    const CheckedPhotograph& photograph = this->Report.Photographs[i];
    camera.Width = photograph.Width > 0 ? photograph.Width : std::max(camera.Width, 1);
    camera.Height = photograph.Height > 0 ? photograph.Height : std::max(camera.Height, 1);
    if (photograph.Width > 0)
    {
      ValidateCamera(camera, this->Report.Cameras[i].Where);
    }
  }
}
}
