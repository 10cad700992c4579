// SPDX-License-Identifier: GPL-3.0-or-later
#include "RunCommand.h"

#include "AtomicFile.h"
#include "CommandSupport.h"
#include "Error.h"
#include "ImageFile.h"
#include "MeshCommand.h"
#include "Metrics.h"
#include "ObjectMesh.h"
#include "Parallel.h"
#include "PhotographFiles.h"
#include "ReportPictures.h"
#include "RunPage.h"
#include "RunReport.h"
#include "SharedWork.h"
#include "Threads.h"
#include "ViewAccess.h"

#include <cstdio>
#include <utility>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
/** The picture to compare with; null when there is none. */
vtkSmartPointer<vtkImageData> TruthOf(const Job& job, const ResolvedView& view)
{
  Photograph truth = view.Truth;
  if (!job.Truth.empty())
  {
    // A picture somebody names is as the novel camera would have taken it.
    truth = Photograph();
    truth.File = job.Truth;
    truth.Mask = MaskFileOf(job.Truth.parent_path(), job.Truth.filename().string());
  }
  if (truth.File.empty())
  {
    return nullptr;
  }
  if (!job.TruthMask.empty())
  {
    truth.Mask = job.TruthMask;
  }
  return ReadTruth(truth, job.Input.Silhouette, view.Cam);
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

/** Everything but the iterations, which are written as they come: pictures and meshes at once. */
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
void WriteRig(const Job& job, const std::string& title, const Camera& novel,
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
  DrawRig(rig, job.Out / "rig.png");
}

/** report.html: last, since it shows what is in the other files and how long they took. */
void WritePage(RunPageInput input, const std::string& jobText, const Console& console)
{
  input.Job = nlohmann::ordered_json::parse(jobText);
  input.Timings = nlohmann::ordered_json::parse(console.TimingsText());
  WriteTextAtomically(input.Folder / "report.html", RunPageHtml(input));
}

/** Says the scores, and where the results are. */
void TellResult(const Job& job, const RunReport& report, Console& console)
{
  for (const auto& [name, scores] : report.Stages())
  {
    console.Info(ScoreLine(name, scores));
  }
  console.Info("novel view: " + (job.Out / "novel.png").string());
  if (job.Page)
  {
    console.Info("report: " + (job.Out / "report.html").string());
  }
  console.Summary();
}
}

void RunJob(const Job& job, Console& console)
{
  SetNumberOfThreads(job.Threads);
  const DatasetIndex index = FindInput(job.Input);
  const ResolvedView view = ResolveViewSpec(job.View, index);
  ValidateCamera(view.Cam, "novel camera");
  PrepareModelFiles(job.MeshOut);
  const std::string jobText = JobText(job);
  AnnounceText(job.Out / "job.json", jobText);
  PrepareFolder(job.Out,
    FilesOfRun(job.UpTo, job.Synthesis.OutlineIterations, job.Synthesis.NonOutlineIterations));
  const auto truth = TruthOf(job, view);
  const auto trueMesh = job.TrueMesh.empty() ? nullptr : LoadObject(job.TrueMesh.string());
  const Dataset dataset = ReadInput(job.Input, index,
    view.HeldOut.empty() ? std::vector<std::string>() : std::vector{ view.HeldOut }, console);

  RunReport report(job.Out, truth);
  DesktopState desktop;
  desktop.Title = (job.View.What == ViewSpec::Kind::File ? job.View.Name : ViewSpecText(job.View)) +
    " of " + index.Folder.filename().string();
  desktop.DisplacementRangePx = 16;
  desktop.Views = dataset.Views;
  desktop.Novel = view.Cam;
  SynthesisListener listener = ListenerFor(console);
  RunPageInput page{ desktop.Title, job.Out, &report, dataset.Views, {}, {}, dataset.Warnings };
  listener.Warn = [&](const std::string& text)
  {
    page.Warnings.push_back(text);
    console.Warn(text);
  };
  if (job.WriteIterations)
  {
    listener.Iteration = [&](const IterationState& state)
    { report.AddIteration(state, job.Screenshots ? &desktop : nullptr); };
  }
  Synthesis synthesis(dataset.Views, job.Synthesis, listener);
  const std::vector<NovelView> stages = synthesis.RenderStages(view.Cam, job.UpTo);
  NovelView oracle;
  if (trueMesh)
  {
    oracle.Image = synthesis.Texture(trueMesh, view.Cam);
  }
  if (!job.MeshOut.empty())
  {
    WriteModelFiles(ToTriangleMesh(stages.back().Mesh, "mesh"), synthesis.Photographs(),
      job.Synthesis, job.TextureSizePx, job.MeshOut, console);
  }
  console.RunTimed("report",
    [&]
    {
      WriteReport(stages, oracle, synthesis, report);
      report.Finish(desktop.Title);
      WriteTextAtomically(job.Out / "job.json", jobText);
      if (job.Page)
      {
        WriteRig(job, desktop.Title, view.Cam, dataset.Views, synthesis.Crust());
      }
    });
  if (job.Page)
  {
    console.RunTimed("report", [&] { WritePage(page, jobText, console); });
  }

  TellResult(job, report, console);
}

void RenderJob(const RenderOptions& options, Console& console, ProcessGroup& processes)
{
  SharedWork work(console, processes, options.Threads);
  const DatasetIndex index = FindInput(options.Input);
  const std::vector<Photograph> cameras = ReadViewCameras(options.Cameras);
  std::vector<fs::path> pictures;
  for (const Photograph& camera : cameras)
  {
    pictures.emplace_back(PictureNameOf(camera.Name));
  }
  Dataset dataset;
  if (work.Writes())
  {
    std::vector<fs::path> files = pictures;
    for (const fs::path& picture : pictures)
    {
      files.push_back("mask" / picture);
    }
    PrepareFolder(options.Out, files);
    dataset = ReadInput(options.Input, index, {}, console);
  }
  const auto synthesis = work.Prepare(dataset.Views, options.Synthesis);
  const auto make = [&](std::size_t item)
  {
    ViewSpec spec;
    spec.What = ViewSpec::Kind::File;
    spec.ParFile = options.Cameras;
    spec.Name = cameras[item].Name;
    const ResolvedView view = ResolveViewSpec(spec, index);
    ValidateCamera(view.Cam, spec.Name);
    WorkResult result;
    result.Images.push_back(PictureOnly(synthesis->Render(view.Cam, options.UpTo).Image));
    return result;
  };
  const auto take = [&](std::size_t item, const WorkResult& result)
  {
    const fs::path& name = pictures[item];
    console.RunTimed("report",
      [&]
      {
        WriteArray(options.Out / name, result.Images.front(), arrays::Color);
        WriteArray(options.Out / "mask" / name, result.Images.front(), arrays::Mask);
      });
    console.Info((options.Out / name).string());
  };
  work.ForEach(cameras.size(), make, take);
  console.Summary();
}
}
