// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/RunReport.h"

#include "Threads.h"
#include "ViewAccess.h"
#include "base/AtomicFile.h"
#include "base/JsonFile.h"
#include "core/Error.h"
#include "images/ImageFile.h"
#include "mesh/PolyDataFile.h"

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkVersion.h>

#include <algorithm>
#include <cstdio>
#include <future>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
/** Shortest text that reads back as the same number. */
std::string Text(double value)
{
  return nlohmann::json(value).dump();
}

/** The mesh; with a vertex at each point when it has no cells, since viewers show cells only. */
vtkSmartPointer<vtkPolyData> WithCells(vtkPolyData* mesh)
{
  if (mesh->GetNumberOfCells() > 0)
  {
    return mesh;
  }
  const vtkIdType count = mesh->GetNumberOfPoints();
  vtkNew<vtkCellArray> vertices;
  vertices->AllocateExact(count, count);
  for (vtkIdType ptId = 0; ptId < count; ++ptId)
  {
    vertices->InsertNextCell(1, &ptId);
  }
  auto shown = vtkSmartPointer<vtkPolyData>::New();
  shown->ShallowCopy(mesh);
  shown->SetVerts(vertices);
  return shown;
}

/** Pixels of the object that no photograph sees, 255. */
Image<std::uint8_t> UnseenMap(vtkImageData* image)
{
  const auto mask = TopDownArray<const unsigned char>(image, arrays::Mask, 1, "novel view", true);
  const auto seen = TopDownArray<const unsigned char>(image, arrays::Seen, 1, "novel view", true);
  Image<std::uint8_t> unseen(mask.Width, mask.Height);
  for (int y = 0; y < mask.Height; ++y)
  {
    for (int x = 0; x < mask.Width; ++x)
    {
      unseen(x, y) = mask(x, y) && !seen(x, y) ? 255 : 0;
    }
  }
  return unseen;
}

/** Error map as a grey image, a level of error a level of grey, four times as bright. */
Image<std::uint8_t> ErrorPicture(vtkImageData* image, vtkImageData* truth)
{
  const Image<float> error =
    ErrorMap(MaskedPictureOf(image, "novel view"), MaskedPictureOf(truth, "truth"));
  Image<std::uint8_t> picture(error.Width, error.Height);
  std::transform(error.Values.begin(), error.Values.end(), picture.Values.begin(),
    [](float value) { return static_cast<std::uint8_t>(std::min(4 * value, 255.f)); });
  return picture;
}
}

nlohmann::ordered_json ScoresJson(const Scores& scores)
{
  return { { "rms", scores.Rms }, { "psnr", scores.Psnr }, { "ssim", scores.Ssim },
    { "iou", scores.Iou }, { "missing", scores.Missing }, { "excess", scores.Excess } };
}

nlohmann::ordered_json VersionsJson()
{
  return { { "novelview", NOVELVIEW_VERSION }, { "vtk", vtkVersion::GetVTKVersion() },
    { "opencv", CV_VERSION },
    { "eigen",
      std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
        std::to_string(EIGEN_MINOR_VERSION) } };
}

std::string IterationName(Stage step, int iteration)
{
  char name[64];
  std::snprintf(
    name, sizeof(name), "%s_%02d", step == Stage::Outline ? "outline" : "nonoutline", iteration);
  return name;
}

std::vector<std::string> PictureStages(Stage upTo)
{
  std::vector<std::string> stages;
  for (int stage = 0; stage <= static_cast<int>(upTo); ++stage)
  {
    stages.push_back(StageName(static_cast<Stage>(stage)));
  }
  stages.emplace_back("oracle");
  return stages;
}

std::vector<fs::path> FilesOfRun(Stage upTo, int outlineIterations, int nonOutlineIterations)
{
  std::vector<fs::path> files{ "novel.png", "novel_mask.png", "novel_depth.tiff",
    "novel_unseen.png", "truth.png", "rms_outline.csv", "rms_nonoutline.csv", "rms.png", "rig.png",
    "summary.json", "report.html", "meshes/iterations.pvd", "meshes/visual_hull.vtp",
    "meshes/power_crust.vtp", "meshes/medial_balls.vtp" };
  for (const std::string& stage : PictureStages(upTo))
  {
    files.push_back("meshes/" + stage + ".vtp");
    for (const char* end : { ".png", "_mask.png", "_error.png" })
    {
      files.push_back("stages/" + stage + end);
    }
  }
  const auto addIterations = [&files](Stage step, int count)
  {
    for (int iteration = 0; iteration <= count; ++iteration)
    {
      const std::string name = IterationName(step, iteration);
      files.push_back("iterations/" + name + ".png");
      files.push_back("iterations/" + name + "_desktop.png");
      files.push_back("meshes/iterations/" + name + ".vtp");
    }
  };
  addIterations(Stage::Outline, outlineIterations);
  addIterations(Stage::Full, nonOutlineIterations);
  return files;
}

RunReport::RunReport(fs::path folder, vtkImageData* truth)
  : Folder(std::move(folder))
  , Truth(truth)
{
}

std::optional<Scores> RunReport::ScoreOf(vtkImageData* image) const
{
  if (!this->Truth)
  {
    return std::nullopt;
  }
  return Compare(MaskedPictureOf(image, "novel view"), MaskedPictureOf(this->Truth, "truth"));
}

void RunReport::AddStage(const std::string& name, vtkImageData* image)
{
  const fs::path stem = this->Folder / "stages" / name;
  WriteArray(stem.string() + ".png", image, arrays::Color);
  WriteArray(stem.string() + "_mask.png", image, arrays::Mask);
  if (this->Truth)
  {
    const Image<std::uint8_t> error = ErrorPicture(image, this->Truth);
    WriteImageFile(stem.string() + "_error.png", error.Ref());
  }
  this->StageScores.emplace_back(name, this->ScoreOf(image));
  this->Images.push_back(image);
}

void RunReport::WriteNovel(vtkImageData* image) const
{
  WriteArray(this->Folder / "novel.png", image, arrays::Color);
  WriteArray(this->Folder / "novel_mask.png", image, arrays::Mask);
  WriteArray(this->Folder / "novel_depth.tiff", image, arrays::Depth);
  const Image<std::uint8_t> unseen = UnseenMap(image);
  WriteImageFile(this->Folder / "novel_unseen.png", unseen.Ref());
  if (this->Truth)
  {
    WriteArray(this->Folder / "truth.png", this->Truth, arrays::Color);
  }
}

void RunReport::WriteMesh(const std::string& name, vtkPolyData* mesh) const
{
  // LZ4, since zlib takes longer than most stages.
  WriteVtp(this->Folder / "meshes" / (name + ".vtp"), WithCells(mesh), VtpCompressor::Lz4);
}

void RunReport::AddIteration(const IterationState& state, Dashboard* desktop)
{
  TableRow& row = this->Rows.emplace_back();
  row.Step = state.Step;
  row.Iteration = state.Iteration;
  row.Score = this->ScoreOf(state.Image);
  row.MeanEnergy = state.MeanEnergy;
  row.MeanPhoto = state.MeanPhoto;
  row.MeanContour = state.MeanContour;
  row.MeanSmooth = state.MeanSmooth;
  row.PointsMoved = state.PointsMoved;
  row.Triangles = static_cast<long>(state.Mesh->GetNumberOfPolys());
  if (row.Score)
  {
    this->History.push_back({ row.Step, row.Iteration, row.Score->Rms, row.Score->Ssim });
  }
  const std::string name = IterationName(state.Step, state.Iteration);
  vtkNew<vtkPolyData> mesh; // of its own, since VTK keeps traversals and bounds in the data
  mesh->DeepCopy(state.Mesh);
  std::future<void> files =
    std::async(NumberOfThreads() > 1 ? std::launch::async : std::launch::deferred,
      [&]
      {
        WriteArray(this->Folder / "iterations" / (name + ".png"), state.Image, arrays::Color);
        this->WriteMesh("iterations/" + name, mesh);
      });
  if (desktop)
  {
    desktop->Step = state.Step;
    desktop->Iteration = state.Iteration;
    desktop->Mesh = state.Mesh;
    desktop->NovelImage = state.Image;
    desktop->TruthImage = this->Truth;
    desktop->History = this->History;
    DrawDesktop(*desktop, this->Folder / "iterations" / (name + "_desktop.png"));
  }
  files.get();
}

std::string RunReport::TableText(Stage step) const
{
  const char* contour = step == Stage::Outline ? "mean_contour" : "mean_hull";
  std::string text = std::string("iteration,rms,psnr,ssim,iou,mean_energy,mean_photo,") + contour +
    ",mean_smooth,points_moved\n";
  for (const TableRow& row : this->Rows)
  {
    if (row.Step != step)
    {
      continue;
    }
    text += std::to_string(row.Iteration) + ",";
    // Without a truth the four columns stay empty.
    text += row.Score ? Text(row.Score->Rms) + "," + Text(row.Score->Psnr) + "," +
        Text(row.Score->Ssim) + "," + Text(row.Score->Iou) + ","
                      : ",,,,";
    text += Text(row.MeanEnergy) + "," + Text(row.MeanPhoto) + "," + Text(row.MeanContour) + "," +
      Text(row.MeanSmooth) + "," + std::to_string(row.PointsMoved) + "\n";
  }
  return text;
}

std::string RunReport::SeriesText() const
{
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
                     "  <Collection>\n";
  int time = 0;
  for (const TableRow& row : this->Rows)
  {
    text += "    <DataSet timestep=\"" + std::to_string(time++) + "\" file=\"iterations/" +
      IterationName(row.Step, row.Iteration) + ".vtp\"/>\n";
  }
  return text + "  </Collection>\n</VTKFile>\n";
}

nlohmann::ordered_json RunReport::Summary() const
{
  nlohmann::ordered_json summary;
  summary["foreground"] = "truth mask united with rendered mask";
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (const auto& [name, scores] : this->StageScores)
  {
    stages[name] =
      scores ? ScoresJson(*scores) : nlohmann::ordered_json(nlohmann::ordered_json::object());
  }
  summary["stages"] = stages;
  const auto find = [this](const std::string& name) -> std::optional<Scores>
  {
    for (const auto& [stage, scores] : this->StageScores)
    {
      if (stage == name)
      {
        return scores;
      }
    }
    return std::nullopt;
  };
  const auto hull = find("hull");
  const auto full = find("full");
  const auto oracle = find("oracle");
  if (hull && full && oracle)
  {
    summary["gap_closure"] = { { "rms", (hull->Rms - full->Rms) / (hull->Rms - oracle->Rms) },
      { "ssim", (hull->Ssim - full->Ssim) / (hull->Ssim - oracle->Ssim) } };
  }
  if (!this->Estimates.is_null())
  {
    summary["estimates"] = this->Estimates;
  }
  return summary;
}

void RunReport::SetEstimates(vtkMultiBlockDataSet* photographs)
{
  const double noise = DepthNoiseOf(photographs);
  if (noise <= 0)
  {
    return; // no depth maps
  }
  std::vector<double> gains;
  for (unsigned int viewId = 0; viewId < photographs->GetNumberOfBlocks(); ++viewId)
  {
    gains.push_back(AttachedNumber(ViewImage(photographs, viewId), arrays::ExposureGain, 1));
  }
  this->Estimates = { { "depth_noise", noise },
    { "silhouette_prior", AttachedNumber(photographs, arrays::SilhouettePrior, 0) },
    { "exposure_gains", gains } };
}

void RunReport::Finish(const std::string& title) const
{
  if (!this->Rows.empty())
  {
    WriteTextAtomically(this->Folder / "rms_outline.csv", this->TableText(Stage::Outline));
    WriteTextAtomically(this->Folder / "rms_nonoutline.csv", this->TableText(Stage::Full));
    WriteTextAtomically(this->Folder / "meshes" / "iterations.pvd", this->SeriesText());
  }
  if (!this->History.empty())
  {
    DrawCharts(title, this->History, this->Folder / "rms.png");
  }
  WriteTextAtomically(this->Folder / "summary.json", DumpJson(this->Summary()) + "\n");
}
}
