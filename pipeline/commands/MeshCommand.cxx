// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/MeshCommand.h"

#include "Threads.h"
#include "ViewAccess.h"
#include "base/AtomicFile.h"
#include "base/InputFile.h"
#include "commands/CommandSupport.h"
#include "mesh/Model.h"
#include "mesh/ModelFile.h"

#include <spdlog/fmt/fmt.h>

namespace novelview
{
namespace fs = std::filesystem;

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

void WriteModelFiles(const TriangleMesh& mesh, vtkMultiBlockDataSet* views,
  const SynthesisOptions& synthesis, int textureSizePx, const std::vector<fs::path>& files,
  Console& console)
{
  TexturedModel model;
  console.RunTimed(
    "mesh texture", [&] { model = MakeTexturedModel(mesh, views, synthesis, textureSizePx); });
  console.Info(fmt::format(
    "mesh: {} points, {} triangles; texture {} x {} px, {} charts, {:.1f} % seen by a photograph",
    model.Mesh.Points.size(), model.Mesh.Triangles.size(), model.Atlas.Picture.Width,
    model.Atlas.Picture.Height, model.Atlas.Charts, 100 * model.Atlas.SeenShare));
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
  const TriangleMesh mesh = ToTriangleMesh(synthesis.WholeObject(options.UpTo), "mesh");
  WriteModelFiles(mesh, views, options.Synthesis, options.TextureSizePx, options.Out, console);
  console.Summary();
}
}
