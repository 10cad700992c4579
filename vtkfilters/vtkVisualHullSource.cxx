// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkVisualHullSource.h"

#include "FilterSupport.h"
#include "ViewAccess.h"
#include "hull/VisualHull.h"

#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkVisualHullSource);

//------------------------------------------------------------------------------
vtkVisualHullSource::vtkVisualHullSource()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(2);
}

//------------------------------------------------------------------------------
int vtkVisualHullSource::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkMultiBlockDataSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkVisualHullSource::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      novelview::ViewNeeds needs;
      needs.ContourDistance = true;
      const std::vector<novelview::View> views =
        novelview::ReadViews(vtkMultiBlockDataSet::GetData(inputs[0]), needs, 2);

      novelview::VisualHullOptions options = this->Options;
      const double* b = this->SearchBounds;
      if (b[0] < b[1] && b[2] < b[3] && b[4] < b[5])
      {
        options.Box = { b[0], b[2], b[4], b[1], b[3], b[5] };
      }
      const novelview::VisualHullResult hull =
        novelview::ComputeVisualHull(views, options, novelview::ExecutionFor(this));

      novelview::TriangleMesh samples;
      samples.Points = hull.Samples.Points;
      vtkPolyData* output = vtkPolyData::GetData(outputs);
      novelview::FromTriangleMesh(samples, output);
      output->GetPointData()->SetNormals(novelview::NewNormals(hull.Samples.Normals));
      novelview::FromTriangleMesh(hull.Surface, vtkPolyData::GetData(outputs, 1));
      this->NumberOfDroppedComponents = hull.DroppedComponents;
      this->NumberOfDroppedSamples = static_cast<vtkIdType>(hull.DroppedSamples);
      this->WorldSpacing = hull.Spacing;
      this->CutByBox = hull.CutByBox;
    });
}

//------------------------------------------------------------------------------
void vtkVisualHullSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintOptions(os, indent);
  if (this->Options.Box)
  {
    os << indent << "Box:";
    for (const double bound : *this->Options.Box)
    {
      os << " " << bound;
    }
    os << "\n";
  }
  os << indent << "SearchBounds:";
  for (const double bound : this->SearchBounds)
  {
    os << " " << bound;
  }
  os << "\n";
  os << indent << "NumberOfDroppedComponents: " << this->NumberOfDroppedComponents << "\n";
  os << indent << "NumberOfDroppedSamples: " << this->NumberOfDroppedSamples << "\n";
  os << indent << "WorldSpacing: " << this->WorldSpacing << "\n";
  os << indent << "CutByBox: " << this->CutByBox << "\n";
}
