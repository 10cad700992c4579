// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkReferenceDepthEstimator.h"

#include "FilterSupport.h"
#include "ReferenceDepth.h"
#include "SilhouettePrior.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkReferenceDepthEstimator);

//------------------------------------------------------------------------------
vtkReferenceDepthEstimator::vtkReferenceDepthEstimator()
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
int vtkReferenceDepthEstimator::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(
    vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkMultiBlockDataSet" : "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkReferenceDepthEstimator::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      vtkMultiBlockDataSet* input = vtkMultiBlockDataSet::GetData(inputs[0]);
      novelview::ViewNeeds needs;
      needs.Color = needs.ContourDistance = true;
      const std::vector<novelview::View> views = novelview::ReadViews(input, needs, 2);
      const novelview::TriangleMesh hull =
        novelview::ToTriangleMesh(vtkPolyData::GetData(inputs[1]), "hull");

      novelview::ReferenceDepthOptions options;
      options.Neighbours = this->Neighbours;
      options.CoarseLastPx = this->SearchDepth;
      options.Match.WindowRadius = this->WindowRadius;
      options.Match.ColorShare = this->ColorShare;
      const auto depths =
        novelview::EstimateReferenceDepths(views, hull, options, novelview::ExecutionFor(this));

      vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputs);
      for (unsigned int viewId = 0; viewId < views.size(); ++viewId)
      {
        vtkNew<vtkImageData> image;
        image->ShallowCopy(novelview::ViewImage(input, viewId));
        novelview::CopyToArray(depths[viewId].Depth, novelview::arrays::Depth, image);
        novelview::CopyToArray(depths[viewId].Confidence, novelview::arrays::Confidence, image);
        novelview::AppendView(output, views[viewId].Name, image, views[viewId].Cam);
      }
      vtkNew<vtkDoubleArray> prior;
      prior->SetName(novelview::arrays::SilhouettePrior);
      prior->InsertNextValue(novelview::FindSilhouettePrior(
        novelview::ReadViews(output, needs, 2), hull, {}, novelview::ExecutionFor(this)));
      output->GetFieldData()->AddArray(prior);
    });
}

//------------------------------------------------------------------------------
void vtkReferenceDepthEstimator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Neighbours: " << this->Neighbours << "\n";
  os << indent << "SearchDepth: " << this->SearchDepth << "\n";
  os << indent << "WindowRadius: " << this->WindowRadius << "\n";
  os << indent << "ColorShare: " << this->ColorShare << "\n";
}
