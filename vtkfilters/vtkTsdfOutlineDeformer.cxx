// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkTsdfOutlineDeformer.h"

#include "DeformerWork.h"
#include "ViewAccess.h"
#include "deformation/TsdfDeformation.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkTsdfOutlineDeformer);

//------------------------------------------------------------------------------
void vtkTsdfOutlineDeformer::Deform(const Work& work)
{
  novelview::TsdfDeformationOptions options = this->TsdfOptions(work.ViewData);
  options.Outline.SilhouettePrior = this->Options.SilhouettePrior > 0
    ? this->Options.SilhouettePrior
    : novelview::AttachedNumber(
        work.ViewData, novelview::arrays::SilhouettePrior, options.Outline.SilhouettePrior);
  options.Silhouette.Support = novelview::AttachedSupport(work.ViewData);
  options.Silhouette.UsePrediction = this->Options.UsePrediction;
  novelview::DeformOutlineByField(
    work.Mesh, work.Visible, work.Views, work.Camera, options, work.Listener, work.Execution);
}

//------------------------------------------------------------------------------
void vtkTsdfOutlineDeformer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
