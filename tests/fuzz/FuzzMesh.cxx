// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh file, from its bytes to the object to be photographed. Compiled once for every format.
#include "FuzzSupport.h"
#include "mesh/MeshFile.h"
#include "mesh/ObjectMesh.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>

#include <cmath>

namespace
{
void CheckFaces(vtkCellArray* faces, vtkIdType pointCount)
{
  vtkNew<vtkIdList> ids;
  for (vtkIdType cellId = 0; cellId < faces->GetNumberOfCells(); ++cellId)
  {
    faces->GetCellAtId(cellId, ids);
    for (const vtkIdType id : *ids)
    {
      if (id < 0 || id >= pointCount)
      {
        fuzz::Fail("face with a point that does not exist");
      }
    }
  }
}

void CheckMesh(vtkPolyData* mesh)
{
  for (vtkIdType ptId = 0; ptId < mesh->GetNumberOfPoints(); ++ptId)
  {
    const double* point = mesh->GetPoint(ptId);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
    {
      fuzz::Fail("point that is not finite");
    }
  }
  CheckFaces(mesh->GetPolys(), mesh->GetNumberOfPoints());
  CheckFaces(mesh->GetStrips(), mesh->GetNumberOfPoints());
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  fuzz::ExpectOnlyErrors(bytes,
    [&]
    {
      const auto mesh = novelview::ParseMesh(bytes, NOVELVIEW_FUZZ_EXTENSION, "file");
      CheckMesh(mesh);
      CheckMesh(novelview::MakeObject(mesh, "file"));
    });
  return 0;
}
