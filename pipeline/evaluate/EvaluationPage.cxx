// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/EvaluationPage.h"

#include "base/NumberText.h"
#include "drawing/ErrorPicture.h"
#include "drawing/OffscreenWindow.h"
#include "report/ReportPictures.h"
#include "report/RunPage.h"

#include <cmath>
#include <filesystem>

namespace novelview
{
namespace
{
constexpr int ShotSidePx = 640;
constexpr double ErrorRange = 80; // grey levels

ReportChart ChartOf(
  const std::vector<EvaluatedView>& views, double Scores::*score, const std::string& title)
{
  ReportChart chart{ title, "view", {}, {} };
  for (const auto& [stage, first] : views.front().Stages)
  {
    ReportLine& line = chart.Lines.emplace_back(ReportLine{ stage, {} });
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      line.Points.push_back({ static_cast<double>(i), FindStage(views[i].Stages, stage)->*score });
    }
  }
  for (const EvaluatedView& view : views)
  {
    chart.XLabels.push_back(std::filesystem::path(view.Name).stem().string());
  }
  return chart;
}

void AddMeans(ReportPage& page, const std::vector<EvaluatedView>& views)
{
  const ScoresByStage means = MeanScores(views);
  const Scores* last = nullptr;
  ReportTable table{ "table-means", "Means over the views", ScoreColumns("stage"), {} };
  for (const auto& [stage, scores] : means)
  {
    last = stage == "oracle" ? last : &scores;
    table.Rows.push_back(ScoreRow(stage, scores));
  }
  std::vector<std::pair<std::string, std::string>> tiles;
  if (last)
  {
    tiles = ScoreTiles(*last);
  }
  if (const auto closure = ClosureOf(means); closure && std::isfinite(closure->Rms))
  {
    tiles.emplace_back("gap to the oracle closed", Formatted("%.0f %%", 100 * closure->Rms));
  }
  tiles.emplace_back("views", std::to_string(views.size()));
  page.AddTiles(tiles);
  page.AddTable(table);
}
}

EvaluationShots ShotsOf(const std::string& name,
  const std::vector<std::pair<std::string, vtkImageData*>>& stages, vtkImageData* truth)
{
  EvaluationShots shots{ name, {} };
  std::string last;
  vtkImageData* lastImage = nullptr;
  for (const auto& [stage, image] : stages)
  {
    shots.Pictures.push_back(EmbedImage(stage, stage, image, ShotSidePx));
    if (stage != "oracle")
    {
      last = stage;
      lastImage = image;
    }
  }
  shots.Pictures.push_back(EmbedImage("truth", "truth", truth, ShotSidePx, true));
  const auto error = ErrorPicture(lastImage, truth, HeatColours(ErrorRange));
  shots.Pictures.push_back(EmbedImage(
    "error of " + last, "error of " + last + ", 0 to 80 grey levels", error, ShotSidePx));
  return shots;
}

std::string EvaluationPageHtml(const EvaluationPageInput& input,
  const std::vector<EvaluatedView>& views, const std::vector<EvaluationShots>& shots,
  vtkMultiBlockDataSet* photographs)
{
  ReportPage page(input.Title,
    "Evaluation of NovelView " + VersionsJson()["novelview"].get<std::string>() + ", " +
      input.Summary.value("mode", std::string()));
  page.BeginSection("result", "Result");
  AddMeans(page, views);
  page.AddCharts(
    { ChartOf(views, &Scores::Rms, "RMS, grey levels"), ChartOf(views, &Scores::Ssim, "SSIM") });
  page.AddText(input.Summary.value("protocol", std::string()));
  if (!shots.empty())
  {
    page.BeginSection("views", "Views");
  }
  for (std::size_t i = 0; i < shots.size(); ++i)
  {
    page.AddText(shots[i].Name);
    page.AddComparison("compare-" + std::to_string(i), shots[i].Pictures, "hull", "truth");
  }
  page.BeginSection("scores", "Scores");
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    ReportTable table{ "table-view-" + std::to_string(i),
      views[i].Name + ", from " + std::to_string(views[i].References) + " photographs",
      ScoreColumns("stage"), {} };
    for (const auto& [stage, scores] : views[i].Stages)
    {
      table.Rows.push_back(ScoreRow(stage, scores));
    }
    page.AddTable(table);
  }
  page.BeginSection("photographs", "Photographs");
  page.AddGallery(PhotographPictures(photographs));
  AddTimings(page, input.Timings);
  const std::string renderer = OffscreenWindow(16, 16).RendererName();
  AddAbout(page, input.Summary["options"], renderer);
  nlohmann::ordered_json data = input.Summary;
  data["renderer"] = renderer;
  data["timings"] = input.Timings;
  return page.Html(data);
}
}
