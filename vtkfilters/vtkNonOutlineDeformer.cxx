// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkNonOutlineDeformer.h"

#include "DeformerWork.h"
#include "deformation/NonOutlineDeformation.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkNonOutlineDeformer);

//------------------------------------------------------------------------------
void vtkNonOutlineDeformer::Deform(const Work& work)
{
  std::vector<std::uint8_t> active = work.Visible;
  for (std::size_t ptId = 0; ptId < active.size(); ++ptId)
  {
    active[ptId] = active[ptId] && !work.Outline[ptId];
  }
  novelview::NonOutlineOptions options = this->Options;
  options.Iterations = this->NumberOfIterations;
  novelview::DeformNonOutline(
    work.Mesh, active, work.Views, work.Camera, options, work.Listener, work.Execution);
}

//------------------------------------------------------------------------------
void vtkNonOutlineDeformer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintOptions(os, indent);
}
