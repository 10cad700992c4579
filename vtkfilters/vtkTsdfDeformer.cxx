// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkTsdfDeformer.h"

#include "ViewAccess.h"
#include "deformation/TsdfDeformation.h"

//------------------------------------------------------------------------------
novelview::TsdfDeformationOptions vtkTsdfDeformer::TsdfOptions(vtkDataObject* views)
{
  novelview::TsdfDeformationOptions options = novelview::OptionsForNoise(this->DepthNoise > 0
      ? this->DepthNoise
      : novelview::AttachedNumber(views, novelview::arrays::DepthNoise, 0));
  options.Iterations = this->NumberOfIterations;
  options.LastOnly = !this->HasObserver(IterationEvent);
  return options;
}

//------------------------------------------------------------------------------
void vtkTsdfDeformer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DepthNoise: " << this->DepthNoise << "\n";
}
