// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis/SynthesisStages.h"

#include "ViewAccess.h"
#include "vtkPinholeCamera.h"

namespace novelview
{
SynthesisStages::SynthesisStages(vtkMultiBlockDataSet* views, const SynthesisOptions& options)
{
  this->Views->SetOutput(views);
  this->Reconciler->SetInputConnection(this->Views->GetOutputPort());
  this->ConnectViews(
    options.ReconcileSilhouettes ? this->Reconciler->GetOutputPort() : this->Views->GetOutputPort(),
    options.UseDepthMaps);
  this->Mesher->SetInputConnection(this->HullSource->GetOutputPort());
  this->DepthEstimator->SetInputConnection(1, this->HullSource->GetOutputPort(1));
  this->Culler->SetInputConnection(this->Mesher->GetOutputPort());
  this->Outline->SetInputConnection(0, this->Culler->GetOutputPort());
  this->NonOutline->SetInputConnection(0, this->Outline->GetOutputPort());
  this->Culler->SetMaximumEdgeLength(options.LongestEdgePx);
  this->SetHullOptions(options);
  this->SetDeformerOptions(options);
  this->SetMapperOptions(options);
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

void SynthesisStages::SetDeformerOptions(const SynthesisOptions& options)
{
  this->Outline->SetNumberOfIterations(options.OutlineIterations);
  this->Outline->SetContourWeight(options.OutlineAlpha);
  this->Outline->SetSmoothWeight(options.OutlineBeta);
  this->Outline->SetSearchRange(options.OutlineSearchPx);
  this->Outline->SetUseDepthMaps(options.UseDepthMaps);
  this->Outline->SetSilhouettePrior(options.SilhouettePrior);
  this->Outline->SetUseContourPrediction(options.ContourPrediction);
  this->Outline->SetDepthNoise(options.DepthNoise);

  this->NonOutline->SetNumberOfIterations(options.NonOutlineIterations);
  this->NonOutline->SetSmoothWeight(options.NonOutlineAlpha);
  this->NonOutline->SetUseDepthMaps(options.UseDepthMaps);
  this->NonOutline->SetDepthNoise(options.DepthNoise);
}

void SynthesisStages::SetMapperOptions(const SynthesisOptions& options)
{
  this->Mapper->SetUseDepthMaps(options.UseDepthMaps);
  this->Mapper->SetUseExposureGains(options.ExposureGains);
  this->Mapper->SetFeatherWidth(options.FeatherPx);
  this->Mapper->SetOcclusionSoftness(options.OcclusionSoftness);
  this->Mapper->SetRimSamples(options.RimSamples);
  this->Mapper->SetSoftRim(options.SoftRim);
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
