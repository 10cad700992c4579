// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkPowerCrustMesher.h"

#include "FilterSupport.h"
#include "crust/PowerCrust.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

vtkStandardNewMacro(vtkPowerCrustMesher);

namespace
{
std::vector<Eigen::Vector3d> UnpackPoints(vtkPolyData* input)
{
  std::vector<Eigen::Vector3d> points(static_cast<std::size_t>(input->GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    input->GetPoint(static_cast<vtkIdType>(i), points[i].data());
  }
  return points;
}

std::vector<Eigen::Vector3d> UnpackNormals(vtkDataArray* normals)
{
  std::vector<Eigen::Vector3d> result(static_cast<std::size_t>(normals->GetNumberOfTuples()));
  for (std::size_t i = 0; i < result.size(); ++i)
  {
    normals->GetTuple(static_cast<vtkIdType>(i), result[i].data());
  }
  return result;
}

vtkSmartPointer<vtkPoints> PackPoints(const std::vector<Eigen::Vector3d>& points)
{
  auto packed = vtkSmartPointer<vtkPoints>::New();
  packed->SetDataTypeToDouble();
  packed->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    packed->SetPoint(static_cast<vtkIdType>(i), points[i].data());
  }
  return packed;
}

void PackMesh(const novelview::TriangleMesh& mesh, vtkPolyData* output)
{
  output->SetPoints(PackPoints(mesh.Points));
  vtkNew<vtkCellArray> triangles;
  triangles->AllocateExact(static_cast<vtkIdType>(mesh.Triangles.size()),
    static_cast<vtkIdType>(3 * mesh.Triangles.size()));
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    const vtkIdType ids[3] = { t[0], t[1], t[2] };
    triangles->InsertNextCell(3, ids);
  }
  output->SetPolys(triangles);
}

/** Copies the samples' point data to the surface's points, with the id of each sample. */
void PackPointData(const std::vector<int>& sources, vtkPolyData* input, vtkPolyData* output)
{
  const vtkIdType count = static_cast<vtkIdType>(sources.size());
  vtkPointData* pointData = output->GetPointData();
  pointData->CopyAllOn();
  pointData->CopyAllocate(input->GetPointData(), count);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName(novelview::arrays::SampleIds);
  ids->SetNumberOfValues(count);
  for (vtkIdType ptId = 0; ptId < count; ++ptId)
  {
    pointData->CopyData(input->GetPointData(), sources[ptId], ptId);
    ids->SetValue(ptId, sources[ptId]);
  }
  pointData->AddArray(ids);
}

void PackBalls(const novelview::MedialBalls& balls, vtkPolyData* output)
{
  output->SetPoints(PackPoints(balls.Centres));
  const vtkIdType count = output->GetNumberOfPoints();
  vtkNew<vtkDoubleArray> radii;
  radii->SetName(novelview::arrays::Radius);
  radii->SetNumberOfValues(count);
  vtkNew<vtkUnsignedCharArray> labels;
  labels->SetName("Label");
  labels->SetNumberOfValues(count);
  vtkNew<vtkCellArray> vertices;
  vertices->AllocateExact(count, count);
  for (vtkIdType ptId = 0; ptId < count; ++ptId)
  {
    radii->SetValue(ptId, balls.Radii[ptId]);
    labels->SetValue(ptId, balls.Inner[ptId] ? 1 : 0);
    vertices->InsertNextCell(1, &ptId);
  }
  output->SetVerts(vertices);
  output->GetPointData()->AddArray(radii);
  output->GetPointData()->AddArray(labels);
}
}

//------------------------------------------------------------------------------
vtkPowerCrustMesher::vtkPowerCrustMesher()
{
  this->SetNumberOfOutputPorts(2);
}

//------------------------------------------------------------------------------
vtkPolyData* vtkPowerCrustMesher::GetMedialBalls()
{
  return this->GetOutput(1);
}

//------------------------------------------------------------------------------
int vtkPowerCrustMesher::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* surface = vtkPolyData::GetData(outputVector, 0);
  vtkPolyData* balls = vtkPolyData::GetData(outputVector, 1);
  return novelview::RunGuarded(this, outputVector,
    [&]
    {
      if (input->GetNumberOfPoints() == 0)
      {
        return;
      }
      const std::vector<Eigen::Vector3d> points = UnpackPoints(input);
      vtkDataArray* normalArray = input->GetPointData()->GetNormals();
      const bool useNormals = this->UseNormals && normalArray;
      const std::vector<Eigen::Vector3d> normals =
        useNormals ? UnpackNormals(normalArray) : std::vector<Eigen::Vector3d>();

      novelview::PowerCrustOptions options = this->Options;
      options.Output = this->OutputType == PowerCrust ? novelview::CrustOutput::PowerCrust
                                                      : novelview::CrustOutput::DelaunayCrust;
      const novelview::PowerCrustResult result = novelview::ComputePowerCrust(
        points, useNormals ? &normals : nullptr, options, novelview::ExecutionFor(this));

      PackMesh(result.Mesh, surface);
      if (!result.PointSources.empty())
      {
        PackPointData(result.PointSources, input, surface);
      }
      PackBalls(result.Balls, balls);
      surface->GetFieldData()->PassData(input->GetFieldData());
    });
}

//------------------------------------------------------------------------------
void vtkPowerCrustMesher::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintOptions(os, indent);
  os << indent
     << "OutputType: " << (this->OutputType == PowerCrust ? "PowerCrust" : "DelaunayCrust") << "\n";
  os << indent << "UseNormals: " << (this->UseNormals ? "on" : "off") << "\n";
}
