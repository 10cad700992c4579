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
  options.Outline.SilhouettePrior = this->SilhouettePrior > 0
    ? this->SilhouettePrior
    : novelview::AttachedNumber(
        work.ViewData, novelview::arrays::SilhouettePrior, options.Outline.SilhouettePrior);
  const std::vector<double> support =
    novelview::AttachedTable(work.ViewData, novelview::arrays::SilhouetteSupport, 4);
  for (std::size_t i = 0; i + 4 <= support.size(); i += 4)
  {
    options.Silhouette.Support.push_back(
      { { support[i], support[i + 1], support[i + 2] }, support[i + 3] });
  }
  options.Silhouette.UsePrediction = this->UseContourPrediction;
  novelview::DeformOutlineByField(
    work.Mesh, work.Visible, work.Views, work.Camera, options, work.Listener, work.Execution);
}

//------------------------------------------------------------------------------
void vtkTsdfOutlineDeformer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SilhouettePrior: " << this->SilhouettePrior << "\n";
  os << indent << "UseContourPrediction: " << this->UseContourPrediction << "\n";
}
