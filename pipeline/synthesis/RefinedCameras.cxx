// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis/RefinedCameras.h"

#include "ViewAccess.h"
#include "synthesis/SceneRunner.h"
#include "synthesis/SynthesisStages.h"

namespace novelview
{
RefinedCameras RefineCamerasOf(vtkMultiBlockDataSet* views, const SynthesisListener& listener)
{
  SynthesisOptions options = PresetOptions("best");
  options.RefineCameras = true;
  SynthesisStages filters(views, options);
  SceneRunner(filters, options, listener).RefineCameras();
  vtkCameraRefiner* refiner = filters.CameraRefiner;
  vtkMultiBlockDataSet* output = refiner->GetOutput();
  RefinedCameras result{ refiner->GetRefined(), refiner->GetErrorBefore(), refiner->GetErrorAfter(),
    {}, {} };
  for (unsigned int viewId = 0; viewId < output->GetNumberOfBlocks(); ++viewId)
  {
    vtkImageData* image = ViewImage(output, viewId);
    result.Cameras.push_back(AttachedCamera(image, "view " + ViewName(output, viewId)));
    result.ShiftsPx.push_back(AttachedNumber(image, arrays::CameraShift, 0));
  }
  return result;
}
}
