// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkWholeObjectRefiner.h"

#include "FilterSupport.h"
#include "deformation/TsdfDeformation.h"
#include "fusion/ModelRefinement.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkWholeObjectRefiner);

//------------------------------------------------------------------------------
vtkWholeObjectRefiner::vtkWholeObjectRefiner()
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
int vtkWholeObjectRefiner::FillInputPortInformation(int port, vtkInformation* info)
{
  novelview::SetInputType(info, port, 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkWholeObjectRefiner::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      vtkMultiBlockDataSet* blocks = vtkMultiBlockDataSet::GetData(inputs[1]);
      const double noise = this->Options.DepthNoise > 0
        ? this->Options.DepthNoise
        : novelview::AttachedNumber(blocks, novelview::arrays::DepthNoise, 0);
      novelview::ModelRefinementOptions options;
      options.Fusion = novelview::OptionsForNoise(noise).Surface;
      const novelview::TriangleMesh refined =
        novelview::RefineModel(novelview::ToTriangleMesh(vtkPolyData::GetData(inputs[0]), "mesh"),
          novelview::ReadColouredViews(blocks), options, novelview::ExecutionFor(this));
      novelview::FromTriangleMesh(refined, vtkPolyData::GetData(outputs));
    });
}

//------------------------------------------------------------------------------
void vtkWholeObjectRefiner::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintOptions(os, indent);
}
