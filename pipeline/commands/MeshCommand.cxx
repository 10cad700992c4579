// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/MeshCommand.h"

#include "Threads.h"
#include "base/AtomicFile.h"
#include "base/InputFile.h"
#include "commands/CommandSupport.h"
#include "mesh/Model.h"
#include "mesh/ModelFile.h"
#include "vtkMeshSimplifier.h"

#include <spdlog/fmt/fmt.h>
#include <vtkNew.h>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/** What was made of the mesh, in one line. */
void ReportMesh(vtkMeshSimplifier* simplifier, Console& console)
{
  vtkPolyData* mesh = simplifier->GetOutput();
  const vtkIdType before = vtkPolyData::SafeDownCast(simplifier->GetInput())->GetNumberOfPolys();
  if (mesh->GetNumberOfPolys() < before)
  {
    console.Info(
      fmt::format("mesh: simplified from {} triangles, at most {:.3f} % of its diagonal away",
        before, 100 * simplifier->GetMaximumDistance() / mesh->GetLength()));
  }
  console.Info(fmt::format("mesh: closed manifold of genus {}, {} pairs of triangles intersect",
    simplifier->GetGenus(), simplifier->GetNumberOfSelfIntersections()));
}
}

void PrepareModelFiles(const std::vector<fs::path>& files)
{
  for (const fs::path& file : files)
  {
    for (const fs::path& part : FilesOfModel(file))
    {
      AnnounceOutput(part);
    }
    RequireWritable(fs::absolute(file).parent_path());
  }
}

void WriteModelFiles(vtkPolyData* mesh, vtkMultiBlockDataSet* views,
  const SynthesisOptions& synthesis, int textureSizePx, const std::vector<fs::path>& files,
  Console& console)
{
  const SynthesisListener listener = ListenerFor(console);
  const TexturedModel model =
    MakeTexturedModel(mesh, views, synthesis, textureSizePx, listener.Progress, listener.StageDone);
  int size[3];
  model.Texture->GetDimensions(size);
  console.Info(fmt::format("mesh: {} points, {} triangles; texture {} x {} px, {} charts cover "
                           "{:.0f} %, {:.1f} % of it seen by a photograph",
    model.Mesh->GetNumberOfPoints(), model.Mesh->GetNumberOfPolys(), size[0], size[1], model.Charts,
    100 * model.UsedShare, 100 * model.SeenShare));
  console.RunTimed("mesh files",
    [&]
    {
      for (const fs::path& file : files)
      {
        WriteModelFile(model, file);
        console.Info("mesh: " + file.string());
      }
    });
}

void MakeMesh(const MeshOptions& options, Console& console)
{
  SetNumberOfThreads(options.Threads);
  const DatasetIndex index = FindInput(options.Input);
  PrepareModelFiles(options.Out);
  const Dataset dataset = ReadInput(options.Input, index, {}, console);
  Synthesis synthesis(dataset.Views, options.Synthesis, ListenerFor(console));
  vtkMultiBlockDataSet* views = synthesis.Photographs();
  vtkNew<vtkMeshSimplifier> simplifier;
  simplifier->SetInputData(synthesis.WholeObject(options.UpTo));
  simplifier->SetOptions(options.Simplification);
  const SynthesisListener listener = ListenerFor(console);
  RunStage("mesh check", simplifier, listener.Progress, listener.StageDone);
  ReportMesh(simplifier, console);
  WriteModelFiles(
    simplifier->GetOutput(), views, options.Synthesis, options.TextureSizePx, options.Out, console);
  console.Summary();
}
}
