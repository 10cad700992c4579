// SPDX-License-Identifier: GPL-3.0-or-later
// Kernels that cost most, on their own.
#include "BenchScene.h"
#include "Benchmarks.h"
#include "Threads.h"
#include "ViewAccess.h"
#include "base/Parallel.h"
#include "core/Execution.h"
#include "crust/PowerCrust.h"
#include "dataset/Dataset.h"
#include "formats/Middlebury.h"
#include "geometry/Rasteriser.h"
#include "silhouettes/ContourDistance.h"
#include "support/TemporaryFolder.h"

#include <vtkMultiBlockDataSet.h>

#include <filesystem>

namespace novelview::bench
{
namespace
{
Execution OnThreads(std::int64_t threads)
{
  LimitThreads(static_cast<int>(threads));
  Execution execution;
  execution.ParallelFor = ParallelFor;
  return execution;
}

/** Arguments: samples, threads. */
void PowerCrust(benchmark::State& state)
{
  Guarded(state,
    [&]
    {
      const OrientedPoints& samples = HullSamples(static_cast<int>(state.range(0)));
      const Execution execution = OnThreads(state.range(1));
      for (auto _ : state)
      {
        benchmark::DoNotOptimize(
          ComputePowerCrust(samples.Points, &samples.Normals, {}, execution));
      }
      state.counters["samples"] = static_cast<double>(samples.Points.size());
    });
}

/** The crust of 12 x 640x480 into the item buffer. Arguments: width of the picture, threads. */
void RasteriseCrust(benchmark::State& state)
{
  Guarded(state,
    [&]
    {
      const TriangleMesh& mesh = Crust();
      const Camera camera = NovelCamera({ 12, static_cast<int>(state.range(0)) });
      const Execution execution = OnThreads(state.range(1));
      for (auto _ : state)
      {
        benchmark::DoNotOptimize(Rasterise(mesh, camera, execution));
      }
      state.counters["triangles"] = static_cast<double>(mesh.Triangles.size());
    });
}

/** Of one photograph. Argument: its width. */
void ContourDistance(benchmark::State& state)
{
  Guarded(state,
    [&]
    {
      vtkMultiBlockDataSet* views = Photographs({ 1, static_cast<int>(state.range(0)) });
      const View view = ReadViews(views, {}).front();
      for (auto _ : state)
      {
        benchmark::DoNotOptimize(SignedContourDistance(view.Mask));
      }
    });
}

/** Photographs and masks from files to views. Arguments: photographs, their width, threads. */
void ReadPhotographs(benchmark::State& state)
{
  Guarded(state,
    [&]
    {
      const support::TemporaryFolder folder;
      WriteDataset(
        Photographs({ static_cast<int>(state.range(0)), static_cast<int>(state.range(1)) }),
        folder.Path, "bunny");
      const DatasetIndex index = ReadDatasetIndex(folder.Path);
      LimitThreads(static_cast<int>(state.range(2)));
      for (auto _ : state)
      {
        benchmark::DoNotOptimize(ReadDataset(index).Views);
      }
    });
}
}

void RegisterKernels()
{
  benchmark::RegisterBenchmark("power_crust", PowerCrust)
    ->ArgNames({ "samples", "threads" })
    ->ArgsProduct({ { 35000, 140000, 560000 }, { 1, 2 } })
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("rasteriser", RasteriseCrust)
    ->ArgNames({ "width", "threads" })
    ->ArgsProduct({ { 640, 1280, 2560 }, { 1, 2 } })
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("contour_distance", ContourDistance)
    ->ArgNames({ "width" })
    ->Arg(320)
    ->Arg(640)
    ->Arg(1280)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("photographs", ReadPhotographs)
    ->ArgNames({ "views", "width", "threads" })
    ->ArgsProduct({ { 12 }, { 320, 640, 1280 }, { 1, 2 } })
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
}
}
