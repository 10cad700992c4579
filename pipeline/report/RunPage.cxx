// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/RunPage.h"

#include "ViewAccess.h"
#include "base/NumberText.h"
#include "drawing/ErrorPicture.h"
#include "drawing/OffscreenWindow.h"
#include "images/ImageFile.h"
#include "report/IterationSection.h"
#include "report/PaperFigures.h"
#include "report/ReportPictures.h"

namespace novelview
{
using Json = nlohmann::ordered_json;

namespace
{
constexpr int StageSidePx = 1280;
constexpr double ErrorRange = 80; ///< end of the colour scale, grey levels

/** Every stage, its error and the truth. */
std::vector<ReportPicture> StagePictures(const RunReport& report)
{
  std::vector<ReportPicture> pictures;
  const auto table = HeatColours(ErrorRange);
  std::vector<ReportPicture> errors;
  for (std::size_t i = 0; i < report.Stages().size(); ++i)
  {
    const auto& [name, scores] = report.Stages()[i];
    vtkImageData* image = report.StageImages()[i];
    pictures.push_back(EmbedImage(name, WithRms(name, scores), image, StageSidePx));
    if (report.TrueImage())
    {
      const auto error = ErrorPicture(image, report.TrueImage(), table);
      errors.push_back(EmbedImage(
        "error of " + name, "error of " + name + ", 0 to 80 grey levels", error, StageSidePx));
    }
  }
  if (report.TrueImage())
  {
    pictures.push_back(EmbedImage("truth", "truth", report.TrueImage(), StageSidePx, true));
  }
  pictures.insert(pictures.end(), errors.begin(), errors.end());
  return pictures;
}

void AddResult(ReportPage& page, const RunPageInput& input)
{
  const RunReport& report = *input.Report;
  page.BeginSection("result", "Result");
  // Stages come before the oracle, which is no result.
  std::optional<Scores> last;
  for (const auto& [name, scores] : report.Stages())
  {
    last = name == "oracle" ? last : scores;
  }
  std::vector<std::pair<std::string, std::string>> tiles;
  if (last)
  {
    tiles = ScoreTiles(*last);
  }
  const Json summary = report.Summary();
  if (summary.contains("gap_closure") && summary["gap_closure"]["rms"].is_number())
  {
    tiles.emplace_back("gap to the oracle closed",
      Formatted("%.0f %%", 100 * summary["gap_closure"]["rms"].get<double>()));
  }
  tiles.emplace_back("photographs", std::to_string(input.Views->GetNumberOfBlocks()));
  page.AddTiles(tiles);
  for (const std::string& warning : input.Warnings)
  {
    page.AddText("Warning: " + warning);
  }
  const std::string shown = report.Stages().size() > 1 && report.Stages().back().first == "oracle"
    ? report.Stages()[report.Stages().size() - 2].first
    : report.Stages().back().first;
  page.AddComparison("compare", StagePictures(report), "hull", shown);
  if (report.TrueImage())
  {
    ReportTable table{ "table-stages",
      "Against the truth, in the foreground (truth's silhouette united with the picture's)",
      ScoreColumns("stage"), {} };
    for (const auto& [name, scores] : report.Stages())
    {
      table.Rows.push_back(ScoreRow(name, scores));
    }
    page.AddTable(table);
  }
}

}

//------------------------------------------------------------------------------
std::vector<std::string> ScoreColumns(const std::string& first)
{
  return { first, "RMS", "PSNR, dB", "SSIM", "IoU", "missing", "excess" };
}

std::vector<ReportCell> ScoreRow(const std::string& name, const std::optional<Scores>& scores)
{
  std::vector<ReportCell> cells{ ReportCell(name) };
  if (scores)
  {
    cells.emplace_back(scores->Rms, "%.3f");
    cells.emplace_back(scores->Psnr, "%.2f");
    for (const double value : { scores->Ssim, scores->Iou, scores->Missing, scores->Excess })
    {
      cells.emplace_back(value, "%.4f");
    }
  }
  return cells;
}

std::vector<std::pair<std::string, std::string>> ScoreTiles(const Scores& scores)
{
  return { { "RMS, grey levels", Formatted("%.2f", scores.Rms) },
    { "PSNR", Formatted("%.2f dB", scores.Psnr) }, { "SSIM", Formatted("%.4f", scores.Ssim) },
    { "IoU of silhouettes", Formatted("%.4f", scores.Iou) } };
}

void AddTimings(ReportPage& page, const Json& timings)
{
  page.BeginSection("timings", "How long it took");
  page.AddTiles({ { "until this page", Formatted("%.2f s", timings["whole"].get<double>()) },
    { "threads", std::to_string(timings["threads"].get<int>()) },
    { "peak memory", Formatted("%.0f MiB", timings["peakMemoryMiB"].get<double>()) } });
  ReportTable table{ "table-timings", "Stages, in the order of their ends", { "stage", "seconds" },
    {} };
  table.BarColumn = 1;
  for (const auto& [stage, seconds] : timings["stages"].items())
  {
    table.Rows.push_back({ ReportCell(stage), ReportCell(seconds.get<double>(), "%.2f") });
  }
  page.AddTable(table);
  if (const double overlap = timings["overlap"].get<double>(); overlap > 0)
  {
    page.AddText(Formatted("Some ran at the same time, for %.2f s.", overlap));
  }
}

void AddAbout(ReportPage& page, const Json& job, const std::string& renderer)
{
  page.BeginSection("about", "About this run");
  const Json versions = VersionsJson();
  ReportTable table{ "table-versions", "Made with", { "part", "version" }, {} };
  for (const auto& [name, version] : versions.items())
  {
    table.Rows.push_back({ ReportCell(name), ReportCell(version.get<std::string>()) });
  }
  table.Rows.push_back({ ReportCell("pictures of scenes"), ReportCell("OSMesa, " + renderer) });
  page.AddTable(table);
  page.AddJson("job", "All options, as JSON", job);
}

std::string RunPageHtml(const RunPageInput& input)
{
  const std::string renderer = OffscreenWindow(16, 16).RendererName();
  ReportPage page(input.Title,
    "Novel view of NovelView " + VersionsJson()["novelview"].get<std::string>() + ", preset " +
      input.Job.value("preset", std::string()));
  AddResult(page, input);
  if (!input.Report->Iterations().empty())
  {
    AddIterations(page, *input.Report, input.Folder);
    AddPaperFigures(page, input);
  }
  page.BeginSection("photographs", "Photographs");
  page.AddText("The photographs that were used, each with the contour of its silhouette.");
  page.AddGallery(PhotographPictures(input.Views));
  page.BeginSection("rig", "Rig");
  const Image<std::uint8_t> rig = ReadColorFile(input.Folder / "rig.png");
  page.AddPicture(EmbedPicture(
    "rig", "The cameras about the power crust; the novel one in yellow", rig.Ref(), 1600));
  AddTimings(page, input.Timings);
  AddAbout(page, input.Job, renderer);

  Json data;
  data["title"] = input.Title;
  data["versions"] = VersionsJson();
  data["renderer"] = renderer;
  data["summary"] = input.Report->Summary();
  data["outline"] = IterationsJson(*input.Report, Stage::Outline);
  data["nonoutline"] = IterationsJson(*input.Report, Stage::Full);
  data["warnings"] = input.Warnings;
  data["job"] = input.Job;
  data["timings"] = input.Timings;
  return page.Html(data);
}
}
