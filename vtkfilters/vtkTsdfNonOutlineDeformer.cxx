// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkTsdfNonOutlineDeformer.h"

#include "DeformerWork.h"
#include "deformation/TsdfDeformation.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkTsdfNonOutlineDeformer);

//------------------------------------------------------------------------------
void vtkTsdfNonOutlineDeformer::Deform(const Work& work)
{
  const std::vector<std::uint8_t> active(work.Visible.size(), 1);
  novelview::DeformNonOutlineByField(work.Mesh, active, work.Views, work.Camera,
    this->TsdfOptions(work.ViewData), work.Listener, work.Execution);
}

//------------------------------------------------------------------------------
void vtkTsdfNonOutlineDeformer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
