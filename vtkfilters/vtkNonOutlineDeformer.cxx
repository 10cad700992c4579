// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkNonOutlineDeformer.h"

#include "FilterSupport.h"
#include "deformation/NonOutlineDeformation.h"
#include "deformation/TsdfDeformation.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkNonOutlineDeformer);

//------------------------------------------------------------------------------
int vtkNonOutlineDeformer::RequestData(
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

      std::vector<std::uint8_t> active = novelview::PointFlags(input, "Visible", 1);
      const auto listener = [&](const novelview::DeformationState& state)
      { this->ReportIteration(state, input); };
      if (this->UseDepthMaps)
      {
        const novelview::TsdfDeformationOptions options =
          this->FieldOptions(vtkDataObject::GetData(inputs[1]));
        // Points nobody sees are at the rim of what is seen; left behind they would be spikes.
        std::fill(active.begin(), active.end(), 1);
        novelview::DeformNonOutlineByField(
          mesh, active, views, camera, options, listener, novelview::ExecutionFor(this));
      }
      else
      {
        const std::vector<std::uint8_t> outline = novelview::PointFlags(input, "OutlineFlag", 0);
        for (std::size_t ptId = 0; ptId < active.size(); ++ptId)
        {
          active[ptId] = active[ptId] && !outline[ptId];
        }
        novelview::NonOutlineOptions options;
        options.Alpha = this->SmoothWeight;
        options.Iterations = this->NumberOfIterations;
        options.SearchPx = this->SearchRange;
        options.WindowRadius = this->WindowRadius;
        options.MatchRangePx = this->MatchRange;
        novelview::DeformNonOutline(
          mesh, active, views, camera, options, listener, novelview::ExecutionFor(this));
      }
      vtkPolyData::GetData(outputs)->ShallowCopy(this->CurrentMesh);
    });
}

//------------------------------------------------------------------------------
void vtkNonOutlineDeformer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SmoothWeight: " << this->SmoothWeight << "\n";
  os << indent << "SearchRange: " << this->SearchRange << "\n";
  os << indent << "WindowRadius: " << this->WindowRadius << "\n";
  os << indent << "MatchRange: " << this->MatchRange << "\n";
}
