// SPDX-License-Identifier: GPL-3.0-or-later
#include "BenchScene.h"

#include "Threads.h"
#include "ViewAccess.h"
#include "core/Execution.h"
#include "generator/Generator.h"
#include "generator/GeneratorRig.h"
#include "generator/SyntheticRenderer.h"
#include "hull/VisualHull.h"
#include "images/ImageFile.h"
#include "mesh/ObjectMesh.h"
#include "silhouettes/ContourDistance.h"
#include "synthesis/StageRunner.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>

#include <cmath>
#include <map>
#include <memory>

namespace novelview::bench
{
namespace
{
GeneratorOptions OptionsFor(const PhotoSet& set)
{
  GeneratorOptions options;
  options.Views = set.Views;
  options.StepDeg = 360.0 / set.Views;
  options.TestAnglesDeg = { options.StepDeg / 2 };
  options.Width = set.Width;
  options.Height = set.Height();
  return options;
}

vtkPolyData* Bunny()
{
  static const vtkSmartPointer<vtkPolyData> bunny = LoadObject("bunny");
  return bunny;
}

vtkSmartPointer<vtkMultiBlockDataSet> TakePhotographs(const PhotoSet& set)
{
  const GeneratorOptions options = OptionsFor(set);
  const Rig rig = MakeRig(Bunny(), options);
  SyntheticRenderer photographer(
    Bunny(), { options.Texture, options.Lit, options.Seed }, options.Supersampling);
  auto views = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (const Camera& camera : rig.Views)
  {
    const RenderedPhotograph photograph = photographer.Take(camera);
    const auto image = NewImage(camera.Width, camera.Height);
    SetPixels(image, arrays::Color, photograph.Color.Ref());
    SetPixels(image, arrays::Mask, photograph.Coverage.Ref());
    const Image<float> distance = SignedContourDistance(photograph.Coverage.Ref());
    SetPixels(image, arrays::ContourDistance, distance.Ref());
    AppendView(views, "bunny" + std::to_string(views->GetNumberOfBlocks()) + ".png", image, camera);
  }
  return views;
}

Execution Parallel()
{
  Execution execution;
  execution.ParallelFor = ParallelFor;
  return execution;
}

VisualHullResult HullAt(double spacingPx)
{
  VisualHullOptions options;
  options.SpacingPx = spacingPx;
  ViewNeeds needs;
  needs.ContourDistance = true;
  return ComputeVisualHull(ReadViews(Photographs({}), needs), options, Parallel());
}
}

vtkMultiBlockDataSet* Photographs(const PhotoSet& set)
{
  static std::map<PhotoSet, vtkSmartPointer<vtkMultiBlockDataSet>> kept;
  auto& views = kept[set];
  if (!views)
  {
    views = TakePhotographs(set);
  }
  return views;
}

Camera NovelCamera(const PhotoSet& set)
{
  return MakeRig(Bunny(), OptionsFor(set)).Tests.front();
}

SynthesisStages& Stages(const PhotoSet& set, const std::string& preset)
{
  static std::map<std::pair<PhotoSet, std::string>, std::unique_ptr<SynthesisStages>> kept;
  auto& stages = kept[{ set, preset }];
  if (!stages)
  {
    stages = std::make_unique<SynthesisStages>(Photographs(set), PresetOptions(preset));
    stages->SetCamera(NovelCamera(set));
    stages->Mapper->SetInputConnection(0, stages->NonOutline->GetOutputPort());
    stages->Mapper->SetInputConnection(2, stages->Culler->GetOutputPort(1));
  }
  return *stages;
}

const OrientedPoints& HullSamples(int count)
{
  static std::map<int, OrientedPoints> kept;
  const auto [samples, fresh] = kept.try_emplace(count);
  if (fresh)
  {
    // A surface has samples as the inverse square of their spacing.
    const double spacingPx = SynthesisOptions().Hull.SpacingPx;
    const double there = HullAt(spacingPx).Samples.Points.size();
    samples->second = HullAt(spacingPx * std::sqrt(there / count)).Samples;
  }
  return samples->second;
}

const TriangleMesh& Crust()
{
  static const TriangleMesh crust = []
  {
    SynthesisStages& stages = Stages({}, "paper");
    RunStage("power crust", stages.Mesher);
    return ToTriangleMesh(stages.Mesher->GetOutput(), "power crust");
  }();
  return crust;
}
}
