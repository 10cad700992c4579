// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis/SynthesisStages.h"

#include "ViewAccess.h"
#include "vtkNonOutlineDeformer.h"
#include "vtkOutlineDeformer.h"
#include "vtkPinholeCamera.h"
#include "vtkTsdfNonOutlineDeformer.h"
#include "vtkTsdfOutlineDeformer.h"

namespace novelview
{
namespace
{
vtkSmartPointer<vtkViewDeformer> MakeOutlineDeformer(const SynthesisOptions& options)
{
  if (options.UseDepthMaps)
  {
    const auto deformer = vtkSmartPointer<vtkTsdfOutlineDeformer>::New();
    deformer->SetNumberOfIterations(options.Outline.Iterations);
    deformer->SetOptions(options.DepthMaps);
    return deformer;
  }
  const auto deformer = vtkSmartPointer<vtkOutlineDeformer>::New();
  deformer->SetNumberOfIterations(options.Outline.Iterations);
  deformer->SetOptions(options.Outline);
  return deformer;
}

vtkSmartPointer<vtkViewDeformer> MakeNonOutlineDeformer(const SynthesisOptions& options)
{
  if (options.UseDepthMaps)
  {
    const auto deformer = vtkSmartPointer<vtkTsdfNonOutlineDeformer>::New();
    deformer->SetNumberOfIterations(options.NonOutline.Iterations);
    deformer->SetOptions(options.DepthMaps);
    return deformer;
  }
  const auto deformer = vtkSmartPointer<vtkNonOutlineDeformer>::New();
  deformer->SetNumberOfIterations(options.NonOutline.Iterations);
  deformer->SetOptions(options.NonOutline);
  return deformer;
}
}

SynthesisStages::SynthesisStages(vtkMultiBlockDataSet* views, const SynthesisOptions& options)
  : Outline(MakeOutlineDeformer(options))
  , NonOutline(MakeNonOutlineDeformer(options))
{
  this->Views->SetOutput(views);
  this->Reconciler->SetInputConnection(this->Views->GetOutputPort());
  this->ConnectViews(
    options.ReconcileSilhouettes ? this->Reconciler->GetOutputPort() : this->Views->GetOutputPort(),
    options.UseDepthMaps);
  this->Mesher->SetInputConnection(this->HullSource->GetOutputPort());
  this->DepthEstimator->SetInputConnection(1, this->HullSource->GetOutputPort(1));
  if (options.RepairSilhouettes)
  {
    this->Repairer->SetInputConnection(0, this->Views->GetOutputPort());
    this->Repairer->SetInputConnection(1, this->HullSource->GetOutputPort(1));
  }
  if (options.RefineCameras && options.UseDepthMaps)
  {
    this->CameraRefiner->SetInputConnection(0, this->Views->GetOutputPort());
    this->CameraRefiner->SetInputConnection(1, this->DepthEstimator->GetOutputPort());
  }
  this->Culler->SetInputConnection(this->Mesher->GetOutputPort());
  this->Outline->SetInputConnection(0, this->Culler->GetOutputPort());
  this->NonOutline->SetInputConnection(0, this->Outline->GetOutputPort());
  this->HullSource->SetOptions(options.Hull);
  this->Culler->SetOptions(options.Culler);
  this->Mapper->SetOptions(options.Texture);
  this->Mapper->SetUseDepthMaps(options.UseDepthMaps);
  this->Fuser->SetDepthNoise(options.DepthMaps.DepthNoise);
  this->Fuser->SetKeepAllComponents(options.Hull.KeepAllComponents);
}

void SynthesisStages::ConnectViews(vtkAlgorithmOutput* silhouettes, bool useDepthMaps)
{
  this->HullSource->SetInputConnection(silhouettes);
  this->DepthEstimator->SetInputConnection(0, silhouettes);
  for (vtkAlgorithm* filter : { static_cast<vtkAlgorithm*>(this->Outline),
         static_cast<vtkAlgorithm*>(this->NonOutline), static_cast<vtkAlgorithm*>(this->Mapper) })
  {
    filter->SetInputConnection(
      1, useDepthMaps ? this->DepthEstimator->GetOutputPort() : silhouettes);
  }
}

void SynthesisStages::SetCamera(const Camera& camera)
{
  const auto pinhole = NewPinholeCamera(camera);
  this->Culler->SetCamera(pinhole);
  this->Outline->SetCamera(pinhole);
  this->NonOutline->SetCamera(pinhole);
  this->Mapper->SetCamera(pinhole);
}
}
