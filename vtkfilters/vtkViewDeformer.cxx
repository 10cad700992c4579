// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkViewDeformer.h"

#include "DeformerWork.h"
#include "FilterSupport.h"

#include <vtkDoubleArray.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

namespace
{
using Member = double novelview::PointEnergy::*;

void AddEnergies(vtkPolyData* mesh, const char* name,
  const std::vector<novelview::PointEnergy>& energies, Member member)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfTuples(static_cast<vtkIdType>(energies.size()));
  for (std::size_t ptId = 0; ptId < energies.size(); ++ptId)
  {
    array->SetValue(static_cast<vtkIdType>(ptId), energies[ptId].*member);
  }
  mesh->GetPointData()->AddArray(array);
}

double MeanOver(const novelview::DeformationState& state, Member member)
{
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t ptId = 0; ptId < state.Energies->size(); ++ptId)
  {
    if ((*state.Active)[ptId])
    {
      sum += (*state.Energies)[ptId].*member;
      ++count;
    }
  }
  return count ? sum / static_cast<double>(count) : 0;
}

/** Displacement from the input's points, on top of what the input had. */
void AddDisplacement(vtkPolyData* mesh, vtkPolyData* input)
{
  vtkDataArray* before = input->GetPointData()->GetArray(novelview::arrays::Displacement);
  vtkNew<vtkDoubleArray> array;
  array->SetName(novelview::arrays::Displacement);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(mesh->GetNumberOfPoints());
  for (vtkIdType ptId = 0; ptId < mesh->GetNumberOfPoints(); ++ptId)
  {
    Eigen::Vector3d now;
    Eigen::Vector3d then;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    mesh->GetPoint(ptId, now.data());
    input->GetPoint(ptId, then.data());
    if (before)
    {
      before->GetTuple(ptId, sum.data());
    }
    sum += now - then;
    array->SetTuple(ptId, sum.data());
  }
  mesh->GetPointData()->AddArray(array);
}

void AddOutlineFlag(vtkPolyData* mesh, const std::vector<std::uint8_t>& active)
{
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName(novelview::arrays::OutlineFlag);
  array->SetNumberOfTuples(static_cast<vtkIdType>(active.size()));
  std::copy(active.begin(), active.end(), array->GetPointer(0));
  mesh->GetPointData()->AddArray(array);
}
}

//------------------------------------------------------------------------------
vtkViewDeformer::vtkViewDeformer()
  : CurrentMesh(vtkSmartPointer<vtkPolyData>::New())
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkViewDeformer::~vtkViewDeformer() = default;

//------------------------------------------------------------------------------
void vtkViewDeformer::SetCamera(vtkPinholeCamera* camera)
{
  novelview::SetCameraMember(this, this->Camera, camera);
}

//------------------------------------------------------------------------------
vtkPinholeCamera* vtkViewDeformer::GetCamera()
{
  return this->Camera;
}

//------------------------------------------------------------------------------
vtkPolyData* vtkViewDeformer::GetCurrentMesh()
{
  return this->CurrentMesh;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkViewDeformer::GetMTime()
{
  return novelview::MTimeWithCamera(this->Superclass::GetMTime(), this->Camera);
}

//------------------------------------------------------------------------------
int vtkViewDeformer::FillInputPortInformation(int port, vtkInformation* info)
{
  novelview::SetInputType(info, port, 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkViewDeformer::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
      const Work work{ novelview::RequireCamera(this->Camera),
        novelview::ToTriangleMesh(input, "mesh"),
        novelview::ReadColouredViews(vtkMultiBlockDataSet::GetData(inputs[1]), 2),
        novelview::PointFlags(input, novelview::arrays::Visible, 1),
        novelview::PointFlags(input, novelview::arrays::OutlineFlag, 0),
        vtkDataObject::GetData(inputs[1]),
        [&](const novelview::DeformationState& state) { this->ReportIteration(state, input); },
        novelview::ExecutionFor(this) };
      this->Deform(work);
      vtkPolyData::GetData(outputs)->ShallowCopy(this->CurrentMesh);
    });
}

//------------------------------------------------------------------------------
void vtkViewDeformer::ReportIteration(const novelview::DeformationState& state, vtkPolyData* input)
{
  vtkNew<vtkPolyData> mesh;
  novelview::FromTriangleMesh(*state.Mesh, mesh);
  mesh->GetPointData()->PassData(input->GetPointData());
  AddDisplacement(mesh, input);
  AddEnergies(mesh, novelview::arrays::Energy, *state.Energies, &novelview::PointEnergy::Total);
  AddEnergies(
    mesh, novelview::arrays::EnergyPhoto, *state.Energies, &novelview::PointEnergy::Photo);
  AddEnergies(mesh, this->ContourArrayName(), *state.Energies, &novelview::PointEnergy::Contour);
  AddEnergies(
    mesh, novelview::arrays::EnergySmooth, *state.Energies, &novelview::PointEnergy::Smooth);
  if (this->MovesOutline())
  {
    AddOutlineFlag(mesh, *state.Active);
  }
  this->CurrentMesh = mesh;
  this->Iteration = state.Iteration;
  this->PointsMoved = state.PointsMoved;
  this->MeanEnergy = MeanOver(state, &novelview::PointEnergy::Total);
  this->MeanPhotoEnergy = MeanOver(state, &novelview::PointEnergy::Photo);
  this->MeanContourEnergy = MeanOver(state, &novelview::PointEnergy::Contour);
  this->MeanSmoothEnergy = MeanOver(state, &novelview::PointEnergy::Smooth);
  this->InvokeEvent(IterationEvent);
}

//------------------------------------------------------------------------------
void vtkViewDeformer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  novelview::PrintCamera(os, indent, this->Camera);
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
  os << indent << "Iteration: " << this->Iteration << "\n";
  os << indent << "PointsMoved: " << this->PointsMoved << "\n";
  os << indent << "MeanEnergy: " << this->MeanEnergy << "\n";
  os << indent << "MeanPhotoEnergy: " << this->MeanPhotoEnergy << "\n";
  os << indent << "MeanContourEnergy: " << this->MeanContourEnergy << "\n";
  os << indent << "MeanSmoothEnergy: " << this->MeanSmoothEnergy << "\n";
  os << indent << "CurrentMesh: " << this->CurrentMesh->GetNumberOfPoints() << " points\n";
}
