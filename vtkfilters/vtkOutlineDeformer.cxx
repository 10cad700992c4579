// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkOutlineDeformer.h"

#include "DeformerWork.h"
#include "deformation/OutlineDeformation.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkOutlineDeformer);

//------------------------------------------------------------------------------
void vtkOutlineDeformer::Deform(const Work& work)
{
  novelview::OutlineOptions options = this->Options;
  options.Iterations = this->NumberOfIterations;
  novelview::DeformOutline(
    work.Mesh, work.Visible, work.Views, work.Camera, options, work.Listener, work.Execution);
}

//------------------------------------------------------------------------------
void vtkOutlineDeformer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintOptions(os, indent);
}
