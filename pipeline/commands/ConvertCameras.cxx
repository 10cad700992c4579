// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/ConvertCameras.h"

#include "base/NumberText.h"
#include "cameras/CameraGrid.h"
#include "commands/CommandSupport.h"
#include "dataset/PhotographSize.h"
#include "synthesis/RefinedCameras.h"

#include <algorithm>

namespace novelview
{
void MendRotations(
  const DatasetIndex& index, std::vector<Photograph>& photographs, Console& console)
{
  constexpr double exact = 1e-10;
  const CameraGrid grid(index.Cameras);
  double worst = 0;
  for (Photograph& photograph : photographs)
  {
    const double off = RotationError(photograph.Cam.R);
    worst = std::max(worst, off);
    if (off > exact)
    {
      photograph.Cam = grid.WithRotation(photograph.Cam);
    }
  }
  if (worst > exact)
  {
    console.Info("rotations to few digits (orthonormal to " + NumberText(worst) +
      "): the nearest exact ones are written");
  }
}

void RefinePoses(const DatasetIndex& index, const std::vector<std::string>& exclude,
  std::vector<Photograph>& photographs, Console& console)
{
  DatasetInput input;
  input.Exclude = exclude;
  DatasetIndex limited = index;
  limited.Notes.clear(); // told before, and the photographs are written as they are
  LimitSize(limited, exclude, {});
  limited.Notes.clear();
  const Dataset dataset = ReadInput(input, limited, {}, console);
  const RefinedCameras refined = RefineCamerasOf(dataset.Views, ListenerFor(console));
  if (!refined.Accepted)
  {
    console.Info("cameras: no others with which the photographs agree better; written as given");
    return;
  }
  console.Info(
    Formatted("cameras refined: photographs disagreed by %.2f px, ", refined.ErrorBeforePx) +
    Formatted("now by %.2f px; shifts:", refined.ErrorAfterPx));
  for (std::size_t i = 0; i < photographs.size(); ++i)
  {
    photographs[i].Cam.R = refined.Cameras[i].R;
    photographs[i].Cam.T = refined.Cameras[i].T;
    const int fileWidth = PhotographOfName(limited.Cameras, photographs[i].Name)->FileWidth;
    const double reduction =
      fileWidth > 0 ? static_cast<double>(fileWidth) / refined.Cameras[i].Width : 1;
    console.Info(
      "  " + photographs[i].Name + Formatted(" %.2f px", reduction * refined.ShiftsPx[i]));
  }
}
}
