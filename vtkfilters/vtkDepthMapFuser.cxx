// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkDepthMapFuser.h"

#include "FilterSupport.h"
#include "fusion/FusedSurface.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkDepthMapFuser);

//------------------------------------------------------------------------------
vtkDepthMapFuser::vtkDepthMapFuser()
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
int vtkDepthMapFuser::FillInputPortInformation(int port, vtkInformation* info)
{
  novelview::SetInputType(info, port, 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkDepthMapFuser::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      vtkMultiBlockDataSet* blocks = vtkMultiBlockDataSet::GetData(inputs[1]);
      novelview::FusedSurfaceOptions options = this->Options;
      options.DepthNoise = novelview::DepthNoiseOf(blocks, options.DepthNoise);
      const novelview::FusedSurface surface = novelview::FuseDepthMaps(
        novelview::ToTriangleMesh(vtkPolyData::GetData(inputs[0]), "mesh").Points,
        novelview::ReadColouredViews(blocks), options, novelview::ExecutionFor(this));
      novelview::FromTriangleMesh(surface.Mesh, vtkPolyData::GetData(outputs));
      this->NumberOfDroppedComponents = surface.Dropped.Components;
      this->NumberOfDroppedTriangles = static_cast<vtkIdType>(surface.Dropped.Triangles);
    });
}

//------------------------------------------------------------------------------
void vtkDepthMapFuser::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintOptions(os, indent);
  os << indent << "NumberOfDroppedComponents: " << this->NumberOfDroppedComponents << "\n";
  os << indent << "NumberOfDroppedTriangles: " << this->NumberOfDroppedTriangles << "\n";
}
