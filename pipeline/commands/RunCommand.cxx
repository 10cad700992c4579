// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/RunCommand.h"

#include "Threads.h"
#include "ViewAccess.h"
#include "base/AtomicFile.h"
#include "base/Parallel.h"
#include "cameras/PhotographFiles.h"
#include "commands/CommandSupport.h"
#include "commands/MeshCommand.h"
#include "core/Error.h"
#include "images/ImageFile.h"
#include "images/Metrics.h"
#include "mesh/ObjectMesh.h"
#include "report/ReportPictures.h"
#include "report/RunPage.h"
#include "report/RunReport.h"

#include <cstdio>
#include <utility>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
/** The image to compare with; null when there is none. */
vtkSmartPointer<vtkImageData> TruthOf(const RunOptions& options, const ResolvedView& view)
{
  Photograph truth = view.Truth;
  if (!options.Truth.empty())
  {
    // An image given by the user is what the novel camera would have photographed.
    truth = Photograph();
    truth.File = options.Truth;
    truth.Mask = MaskFileOf(options.Truth.parent_path(), options.Truth.filename().string());
  }
  if (truth.File.empty())
  {
    return nullptr;
  }
  if (!options.TruthMask.empty())
  {
    truth.Mask = options.TruthMask;
  }
  return ReadTruth(truth, options.Input.Silhouette, view.Cam);
}

std::string ScoreLine(const std::string& name, const std::optional<Scores>& scores)
{
  if (!scores)
  {
    return name;
  }
  char text[160];
  std::snprintf(text, sizeof(text),
    "%-8s RMS %6.2f  PSNR %5.2f dB  SSIM %.4f  IoU %.4f  missing %.4f  excess %.4f", name.c_str(),
    scores->Rms, scores->Psnr, scores->Ssim, scores->Iou, scores->Missing, scores->Excess);
  return text;
}

/** Everything except the iterations, whose images and meshes are written immediately. */
void WriteReport(
  const std::vector<NovelView>& stages, const NovelView& oracle, Synthesis& made, RunReport& report)
{
  std::vector<std::pair<std::string, vtkPolyData*>> meshes = { { "visual_hull", made.Hull() },
    { "power_crust", made.Crust() }, { "medial_balls", made.MedialBalls() } };
  for (std::size_t i = 0; i < stages.size(); ++i)
  {
    meshes.emplace_back(StageName(static_cast<Stage>(i)), stages[i].Mesh);
  }
  const auto writeMeshes = [&]
  {
    for (const auto& [name, mesh] : meshes)
    {
      report.WriteMesh(name, mesh);
    }
  };
  const auto writePictures = [&]
  {
    for (std::size_t i = 0; i < stages.size(); ++i)
    {
      report.AddStage(StageName(static_cast<Stage>(i)), stages[i].Image);
    }
    if (oracle.Image)
    {
      report.AddStage("oracle", oracle.Image);
    }
    report.WriteNovel(stages.back().Image);
  };
  ParallelForEach(2, [&](std::size_t i) { i == 0 ? writePictures() : writeMeshes(); });
}

/** The cameras about the crust, as rig.png. */
void WriteRig(const RunOptions& options, const std::string& title, const Camera& novel,
  vtkMultiBlockDataSet* views, vtkPolyData* crust)
{
  constexpr int photographPx = 320; // in a frustum they are smaller still
  RigPicture rig;
  rig.Title = title;
  rig.Mesh = crust;
  rig.Look = { "grey", true, 0 };
  for (const View& view : ReadViews(views, { false, false, false }))
  {
    rig.Views.push_back(view.Cam);
  }
  rig.Photographs = SmallPhotographs(views, photographPx);
  rig.HeldOut = { novel };
  rig.HeldOutLabels = { "novel" };
  rig.HeldOutName = "novel view";
  DrawRig(rig, options.Out / "rig.png");
}

/** report.html: last, since it shows what is in the other files and how long they took. */
void WritePage(RunPageInput input, const std::string& jobText, const Console& console)
{
  input.Job = nlohmann::ordered_json::parse(jobText);
  input.Timings = nlohmann::ordered_json::parse(console.TimingsText());
  WriteTextAtomically(input.Folder / "report.html", RunPageHtml(input));
}

/** Prints the scores and the folder of the results. */
void ReportResult(const RunOptions& options, const RunReport& report, Console& console)
{
  for (const auto& [name, scores] : report.Stages())
  {
    console.Info(ScoreLine(name, scores));
  }
  console.Info("novel view: " + (options.Out / "novel.png").string());
  if (options.Page)
  {
    console.Info("report: " + (options.Out / "report.html").string());
  }
  console.Summary();
}
}

void RunView(const RunOptions& options, Console& console)
{
  SetNumberOfThreads(options.Threads);
  const DatasetIndex index = FindInput(options.Input);
  const ResolvedView view = ResolveViewSpec(options.View, index);
  ValidateCamera(view.Cam, "novel camera");
  PrepareModelFiles(options.MeshOut);
  const std::string jobText = JobText(options);
  AnnounceText(options.Out / "job.json", jobText);
  PrepareFolder(options.Out,
    FilesOfRun(
      options.UpTo, options.Synthesis.Outline.Iterations, options.Synthesis.NonOutline.Iterations));
  const auto truth = TruthOf(options, view);
  const auto trueMesh = options.TrueMesh.empty() ? nullptr : LoadObject(options.TrueMesh.string());
  const Dataset dataset = ReadInput(options.Input, index,
    view.HeldOut.empty() ? std::vector<std::string>() : std::vector{ view.HeldOut }, console);

  RunReport report(options.Out, truth);
  Dashboard desktop;
  desktop.Title =
    (options.View.What == ViewSpec::Kind::File ? options.View.Name : ViewSpecText(options.View)) +
    " of " + index.Folder.filename().string();
  desktop.DisplacementRangePx = 16;
  desktop.Views = dataset.Views;
  desktop.Novel = view.Cam;
  SynthesisListener listener = ListenerFor(console);
  RunPageInput page{ desktop.Title, options.Out, &report, dataset.Views, {}, {}, dataset.Warnings,
    view.Cam, trueMesh };
  listener.Warn = [&](const std::string& text)
  {
    page.Warnings.push_back(text);
    console.Warn(text);
  };
  if (options.WriteIterations)
  {
    listener.Iteration = [&](const IterationState& state)
    { report.AddIteration(state, options.Screenshots ? &desktop : nullptr); };
  }
  Synthesis synthesis(dataset.Views, options.Synthesis, listener);
  const std::vector<NovelView> stages = synthesis.RenderStages(view.Cam, options.UpTo);
  NovelView oracle;
  if (trueMesh)
  {
    oracle.Image = synthesis.Texture(trueMesh, view.Cam);
  }
  if (!options.MeshOut.empty())
  {
    WriteModelFiles(stages.back().Mesh, synthesis.Photographs(), options.Synthesis,
      options.TextureSizePx, options.MeshOut, console);
  }
  console.RunTimed("report",
    [&]
    {
      WriteReport(stages, oracle, synthesis, report);
      report.SetEstimates(synthesis.Photographs());
      report.Finish(desktop.Title);
      WriteTextAtomically(options.Out / "job.json", jobText);
      if (options.Page)
      {
        WriteRig(options, desktop.Title, view.Cam, dataset.Views, synthesis.Crust());
      }
    });
  if (options.Page)
  {
    console.RunTimed("report", [&] { WritePage(page, jobText, console); });
  }

  ReportResult(options, report, console);
}
}
