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
    deformer->SetNumberOfIterations(options.OutlineIterations);
    deformer->SetSilhouettePrior(options.SilhouettePrior);
    deformer->SetUseContourPrediction(options.ContourPrediction);
    deformer->SetDepthNoise(options.DepthNoise);
    return deformer;
  }
  const auto deformer = vtkSmartPointer<vtkOutlineDeformer>::New();
  deformer->SetNumberOfIterations(options.OutlineIterations);
  deformer->SetContourWeight(options.OutlineAlpha);
  deformer->SetSmoothWeight(options.OutlineBeta);
  deformer->SetSearchRange(options.OutlineSearchPx);
  return deformer;
}

vtkSmartPointer<vtkViewDeformer> MakeNonOutlineDeformer(const SynthesisOptions& options)
{
  if (options.UseDepthMaps)
  {
    const auto deformer = vtkSmartPointer<vtkTsdfNonOutlineDeformer>::New();
    deformer->SetNumberOfIterations(options.NonOutlineIterations);
    deformer->SetDepthNoise(options.DepthNoise);
    return deformer;
  }
  const auto deformer = vtkSmartPointer<vtkNonOutlineDeformer>::New();
  deformer->SetNumberOfIterations(options.NonOutlineIterations);
  deformer->SetSmoothWeight(options.NonOutlineAlpha);
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
  this->Culler->SetMaximumEdgeLength(options.LongestEdgePx);
  this->SetHullOptions(options);
  this->SetMapperOptions(options);
  this->Refiner->SetDepthNoise(options.DepthNoise);
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

void SynthesisStages::SetHullOptions(const SynthesisOptions& options)
{
  this->HullSource->SetSampleSpacing(options.HullSpacingPx);
  this->HullSource->SetKeepAllComponents(options.HullKeepAll);
  if (options.HullBox)
  {
    const auto& b = *options.HullBox;
    this->HullSource->SetSearchBounds(b[0], b[3], b[1], b[4], b[2], b[5]);
  }
}

void SynthesisStages::SetMapperOptions(const SynthesisOptions& options)
{
  this->Mapper->SetUseDepthMaps(options.UseDepthMaps);
  this->Mapper->SetUseExposureGains(options.ExposureGains);
  this->Mapper->SetFeatherWidth(options.FeatherPx);
  this->Mapper->SetOcclusionSoftness(options.OcclusionSoftness);
  this->Mapper->SetBoundarySamples(options.BoundarySamples);
  this->Mapper->SetSoftBoundary(options.SoftBoundary);
  this->Mapper->SetReferences(options.References);
  this->Mapper->SetPower(options.Power);
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
