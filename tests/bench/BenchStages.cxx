// SPDX-License-Identifier: GPL-3.0-or-later
// The filters as a run uses them, each again and again with everything before it up to date.
#include "BenchScene.h"
#include "Benchmarks.h"
#include "base/Parallel.h"
#include "synthesis/StageRunner.h"

#include <vtkImageData.h>

namespace novelview::bench
{
namespace
{
struct StageBenchmark
{
  const char* Name;
  const char* Preset;
  vtkAlgorithm* (*Filter)(SynthesisStages&);
  int LargestWidth; ///< of the photographs and the novel view, px
};

const StageBenchmark All[] = {
  { "silhouettes", "best", [](SynthesisStages& s) -> vtkAlgorithm* { return s.Reconciler; }, 1280 },
  { "visual_hull", "paper", [](SynthesisStages& s) -> vtkAlgorithm* { return s.HullSource; },
    1280 },
  { "depth_maps", "best", [](SynthesisStages& s) -> vtkAlgorithm* { return s.DepthEstimator; },
    640 },
  { "culling", "paper", [](SynthesisStages& s) -> vtkAlgorithm* { return s.Culler; }, 640 },
  { "outline", "paper", [](SynthesisStages& s) -> vtkAlgorithm* { return s.Outline; }, 640 },
  { "outline", "best", [](SynthesisStages& s) -> vtkAlgorithm* { return s.Outline; }, 640 },
  { "nonoutline", "paper", [](SynthesisStages& s) -> vtkAlgorithm* { return s.NonOutline; }, 640 },
  { "nonoutline", "best", [](SynthesisStages& s) -> vtkAlgorithm* { return s.NonOutline; }, 640 },
  { "texture", "paper", [](SynthesisStages& s) -> vtkAlgorithm* { return s.Mapper; }, 640 },
  { "texture", "best", [](SynthesisStages& s) -> vtkAlgorithm* { return s.Mapper; }, 640 },
};

/** Arguments: photographs, their width, threads. */
void RunFilter(benchmark::State& state, const StageBenchmark& stage)
{
  const PhotoSet set{ static_cast<int>(state.range(0)), static_cast<int>(state.range(1)) };
  Guarded(state,
    [&]
    {
      vtkAlgorithm* filter = stage.Filter(Stages(set, stage.Preset));
      LimitThreads(0);
      RunStage(stage.Name, filter); // and everything before it
      LimitThreads(static_cast<int>(state.range(2)));
      for (auto _ : state)
      {
        filter->Modified();
        RunStage(stage.Name, filter);
      }
    });
}
}

void RegisterStages()
{
  for (const StageBenchmark& stage : All)
  {
    const std::string name = std::string(stage.Name) + "/" + stage.Preset;
    auto* registered = benchmark::RegisterBenchmark(
      name.c_str(), [&stage](benchmark::State& state) { RunFilter(state, stage); });
    registered->ArgNames({ "views", "width", "threads" });
    for (int width = 320; width <= stage.LargestWidth; width *= 2)
    {
      registered->Args({ 12, width, 1 })->Args({ 12, width, 2 });
    }
    registered->UseRealTime()->Unit(benchmark::kMillisecond);
  }
}
}
