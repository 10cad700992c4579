// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkVisibilityCuller.h"

#include "FilterSupport.h"
#include "ViewAccess.h"
#include "geometry/EdgeSplitting.h"
#include "geometry/NovelProjection.h"
#include "geometry/Rasteriser.h"
#include "geometry/Visibility.h"
#include "vtkPinholeCamera.h"

#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

vtkStandardNewMacro(vtkVisibilityCuller);

namespace
{
using novelview::Error;

/** The triangles that satisfy `keep`, and for each point used its id in the whole mesh. */
template <class Keep>
novelview::TriangleMesh Extract(
  const novelview::TriangleMesh& whole, const Keep& keep, std::vector<int>& originalIds)
{
  novelview::TriangleMesh part;
  std::vector<int> newId(whole.Points.size(), -1);
  for (const Eigen::Vector3i& t : whole.Triangles)
  {
    if (!keep(t))
    {
      continue;
    }
    Eigen::Vector3i triangle;
    for (int corner = 0; corner < 3; ++corner)
    {
      int& id = newId[t[corner]];
      if (id < 0)
      {
        id = static_cast<int>(part.Points.size());
        part.Points.push_back(whole.Points[t[corner]]);
        originalIds.push_back(t[corner]);
      }
      triangle[corner] = id;
    }
    part.Triangles.push_back(triangle);
  }
  return part;
}

/** In arrays of reals the middles of cut edges, which come last, get the mean of the ends. */
void SetMeans(vtkPointData* input, const std::vector<int>& keptIds,
  const std::vector<std::array<int, 2>>& cutEdges, vtkPointData* output)
{
  for (int i = 0; i < output->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = output->GetArray(i);
    if (!array || (array->GetDataType() != VTK_FLOAT && array->GetDataType() != VTK_DOUBLE))
    {
      continue;
    }
    vtkDataArray* from = input->GetArray(array->GetName());
    auto ptId = static_cast<vtkIdType>(keptIds.size());
    for (const auto& [a, b] : cutEdges)
    {
      array->InterpolateTuple(ptId++, keptIds[a], from, keptIds[b], from, 0.5);
    }
  }
}

/** The data of points that remain, and then of the middles of cut edges between two of them. */
void SetPointData(vtkPointData* input, const std::vector<std::uint8_t>& visible,
  const std::vector<int>& keptIds, const std::vector<std::array<int, 2>>& cutEdges,
  vtkPointData* output)
{
  const auto kept = static_cast<vtkIdType>(keptIds.size());
  const vtkIdType count = kept + static_cast<vtkIdType>(cutEdges.size());
  vtkNew<vtkUnsignedCharArray> visibleArray;
  visibleArray->SetName(novelview::arrays::Visible);
  visibleArray->SetNumberOfTuples(count);
  vtkNew<vtkIdTypeArray> idArray;
  idArray->SetName(novelview::arrays::OriginalPointIds);
  idArray->SetNumberOfTuples(count);
  output->CopyAllocate(input, count);
  for (vtkIdType ptId = 0; ptId < kept; ++ptId)
  {
    visibleArray->SetValue(ptId, visible[keptIds[ptId]]);
    idArray->SetValue(ptId, keptIds[ptId]);
    output->CopyData(input, keptIds[ptId], ptId);
  }
  for (vtkIdType ptId = kept; ptId < count; ++ptId)
  {
    const int a = keptIds[cutEdges[ptId - kept][0]];
    const int b = keptIds[cutEdges[ptId - kept][1]];
    visibleArray->SetValue(ptId, visible[a] && visible[b]);
    idArray->SetValue(ptId, -1);
    output->CopyData(input, a, ptId); // ids and flags have no mean
  }
  SetMeans(input, keptIds, cutEdges, output);
  output->AddArray(visibleArray);
  output->AddArray(idArray);
}

void CheckCamera(const novelview::Camera& camera, const novelview::TriangleMesh& mesh,
  const std::vector<std::uint8_t>& visible)
{
  if (novelview::IsInside(mesh, camera.Centre()))
  {
    throw Error("novel camera", "it is inside the object");
  }
  for (std::size_t ptId = 0; ptId < mesh.Points.size(); ++ptId)
  {
    if (visible[ptId] && camera.InFrame(camera.Project(mesh.Points[ptId])))
    {
      return;
    }
  }
  // A close-up may have all vertices outside the frame and the object across it.
  const std::vector<int> cells = novelview::Rasterise(mesh, camera).CellId.Values;
  if (std::all_of(cells.begin(), cells.end(), [](int cellId) { return cellId < 0; }))
  {
    throw Error(
      "novel camera", "no part of the object is in its frame: it faces away from the object");
  }
}
}

//------------------------------------------------------------------------------
vtkVisibilityCuller::vtkVisibilityCuller()
{
  this->SetNumberOfOutputPorts(2);
}

//------------------------------------------------------------------------------
vtkVisibilityCuller::~vtkVisibilityCuller() = default;

//------------------------------------------------------------------------------
void vtkVisibilityCuller::SetCamera(vtkPinholeCamera* camera)
{
  novelview::SetCameraMember(this, this->Camera, camera);
}

//------------------------------------------------------------------------------
vtkPinholeCamera* vtkVisibilityCuller::GetCamera()
{
  return this->Camera;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkVisibilityCuller::GetMTime()
{
  return novelview::MTimeWithCamera(this->Superclass::GetMTime(), this->Camera);
}

//------------------------------------------------------------------------------
int vtkVisibilityCuller::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
      const novelview::Camera camera = novelview::RequireCamera(this->Camera);
      const novelview::TriangleMesh mesh = novelview::ToTriangleMesh(input, "mesh");
      if (mesh.Triangles.empty())
      {
        return;
      }
      const std::vector<std::uint8_t> visible = novelview::VisibleVertices(
        mesh, camera, this->Options.Tolerance, novelview::ExecutionFor(this));
      CheckCamera(camera, mesh, visible);

      const auto anyVisible = [&visible](const Eigen::Vector3i& t)
      { return visible[t[0]] || visible[t[1]] || visible[t[2]]; };
      const novelview::NovelProjection projection(mesh, camera);
      const auto isOccluder = [&](const Eigen::Vector3i& t)
      { return !anyVisible(t) || !projection.Faces(t); };
      std::vector<int> keptIds;
      std::vector<int> removedIds;
      novelview::SplitMesh kept{ Extract(mesh, anyVisible, keptIds), {} };
      if (this->Options.LongestEdgePx > 0)
      {
        kept = novelview::SplitLongEdges(kept.Mesh, camera, this->Options.LongestEdgePx);
      }
      vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
      novelview::FromTriangleMesh(kept.Mesh, output);
      SetPointData(input->GetPointData(), visible, keptIds, kept.Ends, output->GetPointData());
      novelview::FromTriangleMesh(
        Extract(mesh, isOccluder, removedIds), vtkPolyData::GetData(outputs, 1));
    });
}

//------------------------------------------------------------------------------
void vtkVisibilityCuller::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintOptions(os, indent);
  novelview::PrintCamera(os, indent, this->Camera);
}
