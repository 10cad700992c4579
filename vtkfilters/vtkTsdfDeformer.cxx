// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkTsdfDeformer.h"

#include "ViewAccess.h"
#include "deformation/TsdfDeformation.h"

//------------------------------------------------------------------------------
novelview::TsdfDeformationOptions vtkTsdfDeformer::TsdfOptions(vtkDataObject* views)
{
  novelview::TsdfDeformationOptions options =
    novelview::OptionsForNoise(novelview::DepthNoiseOf(views, this->Options.DepthNoise));
  options.Iterations = this->NumberOfIterations;
  options.LastOnly = !this->HasObserver(IterationEvent);
  return options;
}

//------------------------------------------------------------------------------
void vtkTsdfDeformer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintOptions(os, indent);
}
