// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkMeshSimplifier.h"

#include "FilterSupport.h"
#include "geometry/MeshSimplification.h"
#include "geometry/MeshTopology.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <utility>

vtkStandardNewMacro(vtkMeshSimplifier);

//------------------------------------------------------------------------------
int vtkMeshSimplifier::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->MaximumDistance = 0;
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
      vtkPolyData* output = vtkPolyData::GetData(outputs);
      novelview::TriangleMesh mesh = novelview::ToTriangleMesh(input, "mesh");
      const auto wanted = static_cast<std::size_t>(this->Options.Triangles);
      if (wanted > 0 && wanted < mesh.Triangles.size())
      {
        novelview::SimplifiedMesh simple =
          novelview::SimplifyMesh(mesh, wanted, novelview::ExecutionFor(this));
        mesh = std::move(simple.Mesh);
        this->MaximumDistance = simple.MaxDistance;
        novelview::FromTriangleMesh(mesh, output);
      }
      else
      {
        output->ShallowCopy(input);
      }
      this->NumberOfSelfIntersections =
        static_cast<vtkIdType>(novelview::CountSelfIntersections(mesh));
      this->Genus = novelview::ExamineTopology(mesh).Genus();
    });
}

//------------------------------------------------------------------------------
void vtkMeshSimplifier::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintOptions(os, indent);
  os << indent << "MaximumDistance: " << this->MaximumDistance << "\n";
  os << indent << "NumberOfSelfIntersections: " << this->NumberOfSelfIntersections << "\n";
  os << indent << "Genus: " << this->Genus << "\n";
}
