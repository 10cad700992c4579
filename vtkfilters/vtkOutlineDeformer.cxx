// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkOutlineDeformer.h"

#include "DeformerWork.h"
#include "deformation/OutlineDeformation.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkOutlineDeformer);

//------------------------------------------------------------------------------
void vtkOutlineDeformer::Deform(const Work& work)
{
  novelview::OutlineOptions options;
  options.Alpha = this->ContourWeight;
  options.Beta = this->SmoothWeight;
  options.Iterations = this->NumberOfIterations;
  options.SearchPx = this->SearchRange;
  options.WindowRadius = this->WindowRadius;
  options.SigmaPx = this->ContourSigma;
  novelview::DeformOutline(
    work.Mesh, work.Visible, work.Views, work.Camera, options, work.Listener, work.Execution);
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
}
