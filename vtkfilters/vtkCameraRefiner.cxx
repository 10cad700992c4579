// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkCameraRefiner.h"

#include "FilterSupport.h"
#include "calibration/CameraRefinement.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkCameraRefiner);

//------------------------------------------------------------------------------
vtkCameraRefiner::vtkCameraRefiner()
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
int vtkCameraRefiner::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Refined = false;
  this->ErrorBefore = this->ErrorAfter = 0;
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      vtkMultiBlockDataSet* input = vtkMultiBlockDataSet::GetData(inputs[0]);
      const std::vector<novelview::View> views =
        novelview::ReadColouredViews(vtkMultiBlockDataSet::GetData(inputs[1]), 2);
      if (input->GetNumberOfBlocks() != views.size())
      {
        throw novelview::Error("views", "the inputs differ in number",
          std::to_string(views.size()) + " with depth maps",
          std::to_string(input->GetNumberOfBlocks()));
      }
      novelview::RequireDepthMaps(views);
      const novelview::CameraRefinement refinement =
        novelview::RefineCameras(views, this->Options, novelview::ExecutionFor(this));
      this->Refined = refinement.Accepted;
      this->ErrorBefore = refinement.ErrorBeforePx;
      this->ErrorAfter = refinement.ErrorAfterPx;
      vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputs);
      for (unsigned int viewId = 0; viewId < views.size(); ++viewId)
      {
        vtkNew<vtkImageData> image;
        image->ShallowCopy(novelview::ViewImage(input, viewId));
        novelview::AttachNumber(image, novelview::arrays::CameraShift, refinement.ShiftsPx[viewId]);
        novelview::AppendView(
          output, novelview::ViewName(input, viewId), image, refinement.Cameras[viewId]);
      }
    });
}

//------------------------------------------------------------------------------
void vtkCameraRefiner::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintOptions(os, indent);
  os << indent << "Refined: " << (this->Refined ? "yes" : "no") << "\n";
  os << indent << "ErrorBefore: " << this->ErrorBefore << "\n";
  os << indent << "ErrorAfter: " << this->ErrorAfter << "\n";
}
