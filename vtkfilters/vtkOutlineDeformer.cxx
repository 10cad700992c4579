// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkOutlineDeformer.h"

#include "FilterSupport.h"
#include "deformation/OutlineDeformation.h"
#include "deformation/TsdfDeformation.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkOutlineDeformer);

//------------------------------------------------------------------------------
int vtkOutlineDeformer::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
      const novelview::Camera camera = novelview::RequireCamera(this->Camera);
      const novelview::TriangleMesh mesh = novelview::ToTriangleMesh(input, "mesh");
      novelview::ViewNeeds needs;
      needs.Color = needs.ContourDistance = true;
      const std::vector<novelview::View> views =
        novelview::ReadViews(vtkMultiBlockDataSet::GetData(inputs[1]), needs, 2);

      const std::vector<std::uint8_t> visible = novelview::PointFlags(input, "Visible", 1);
      const auto listener = [&](const novelview::DeformationState& state)
      { this->ReportIteration(state, input); };
      if (this->UseDepthMaps)
      {
        vtkDataObject* maps = vtkDataObject::GetData(inputs[1]);
        novelview::TsdfDeformationOptions options = this->FieldOptions(maps);
        options.Outline.SilhouettePrior = this->SilhouettePrior > 0
          ? this->SilhouettePrior
          : novelview::AttachedNumber(
              maps, novelview::arrays::SilhouettePrior, options.Outline.SilhouettePrior);
        options.Silhouette.PredictionWeight *= this->UseContourPrediction;
        novelview::DeformOutlineByField(
          mesh, visible, views, camera, options, listener, novelview::ExecutionFor(this));
      }
      else
      {
        novelview::OutlineOptions options;
        options.Alpha = this->ContourWeight;
        options.Beta = this->SmoothWeight;
        options.Iterations = this->NumberOfIterations;
        options.SearchPx = this->SearchRange;
        options.WindowRadius = this->WindowRadius;
        options.SigmaPx = this->ContourSigma;
        novelview::DeformOutline(
          mesh, visible, views, camera, options, listener, novelview::ExecutionFor(this));
      }
      vtkPolyData::GetData(outputs)->ShallowCopy(this->CurrentMesh);
    });
}

//------------------------------------------------------------------------------
void vtkOutlineDeformer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ContourWeight: " << this->ContourWeight << "\n";
  os << indent << "SmoothWeight: " << this->SmoothWeight << "\n";
  os << indent << "SearchRange: " << this->SearchRange << "\n";
  os << indent << "WindowRadius: " << this->WindowRadius << "\n";
  os << indent << "ContourSigma: " << this->ContourSigma << "\n";
  os << indent << "SilhouettePrior: " << this->SilhouettePrior << "\n";
  os << indent << "UseContourPrediction: " << this->UseContourPrediction << "\n";
}
