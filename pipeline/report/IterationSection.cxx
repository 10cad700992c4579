// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/IterationSection.h"

#include "base/NumberText.h"
#include "base/Parallel.h"
#include "images/ImageFile.h"
#include "report/ReportPictures.h"

#include <vector>

namespace novelview
{
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace
{
constexpr int IterationSidePx = 720;
constexpr int SceneSidePx = 1200;
constexpr std::size_t MaxFrames = 60;

std::string StepTitle(Stage step)
{
  return step == Stage::Outline ? "Outline deformer" : "Non-outline deformer";
}

std::vector<ReportFrame> IterationFrames(const RunReport& report, const fs::path& folder)
{
  const std::vector<TableRow>& rows = report.Iterations();
  std::vector<const TableRow*> shown;
  const std::size_t stride = (rows.size() + MaxFrames - 1) / MaxFrames;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    if (i % stride == 0 || i + 1 == rows.size())
    {
      shown.push_back(&rows[i]);
    }
  }
  std::vector<ReportFrame> frames(shown.size());
  ParallelForEach(shown.size(),
    [&](std::size_t i)
    {
      const TableRow& row = *shown[i];
      ReportFrame& frame = frames[i];
      frame.Caption =
        WithRms(StepTitle(row.Step) + ", iteration " + std::to_string(row.Iteration), row.Score);
      const fs::path stem = folder / "iterations" / IterationName(row.Step, row.Iteration);
      const auto add = [&frame](const char* track, const fs::path& file, int sidePx)
      {
        const Image<std::uint8_t> pixels = ReadColorFile(file);
        frame.Pictures.push_back(EmbedPicture(track, frame.Caption, pixels.Ref(), sidePx, 85));
      };
      add("novel view", stem.string() + ".png", IterationSidePx);
      const fs::path desktop = stem.string() + "_desktop.png";
      if (fs::exists(desktop))
      {
        add("scene", desktop, SceneSidePx);
      }
    });
  return frames;
}

ReportTable IterationTable(const RunReport& report, Stage step)
{
  const bool outline = step == Stage::Outline;
  ReportTable table;
  table.Id = outline ? "table-outline" : "table-nonoutline";
  table.Caption = StepTitle(step);
  table.Columns = { "iteration", "RMS", "PSNR, dB", "SSIM", "IoU", "mean energy", "photo",
    outline ? "contour" : "hull", "smooth", "points moved" };
  for (const TableRow& row : report.Iterations())
  {
    if (row.Step != step)
    {
      continue;
    }
    std::vector<ReportCell>& cells = table.Rows.emplace_back();
    cells.emplace_back(row.Iteration, "%.0f");
    const Scores scores = row.Score.value_or(Scores());
    const auto score = [&](double value, const char* format)
    { cells.push_back(row.Score ? ReportCell(value, format) : ReportCell("")); };
    score(scores.Rms, "%.3f");
    score(scores.Psnr, "%.2f");
    score(scores.Ssim, "%.4f");
    score(scores.Iou, "%.4f");
    for (const double value : { row.MeanEnergy, row.MeanPhoto, row.MeanContour, row.MeanSmooth })
    {
      cells.emplace_back(value, "%.4g");
    }
    cells.emplace_back(static_cast<double>(row.PointsMoved), "%.0f");
  }
  return table;
}

/** A score over the outline iterations followed by the non-outline ones. */
ReportChart ScoreChart(const RunReport& report, double Scores::*score, const std::string& title)
{
  ReportChart chart;
  chart.Title = title;
  chart.XTitle = "iteration";
  for (const Stage step : { Stage::Outline, Stage::Full })
  {
    ReportLine line{ step == Stage::Outline ? "outline" : "non-outline", {} };
    double x = chart.Lines.empty() || chart.Lines.front().Points.empty()
      ? 0
      : chart.Lines.front().Points.back()[0];
    for (const TableRow& row : report.Iterations())
    {
      if (row.Step == step && row.Score)
      {
        line.Points.push_back({ x++, (*row.Score).*score });
      }
    }
    if (!line.Points.empty())
    {
      chart.Lines.push_back(line);
    }
  }
  return chart;
}

ReportChart EnergyChart(const RunReport& report, Stage step)
{
  const char* contour = step == Stage::Outline ? "contour" : "hull";
  ReportChart chart;
  chart.Title = StepTitle(step) + ": mean energy and its terms";
  chart.XTitle = "iteration";
  chart.Lines = { { "energy", {} }, { "photo", {} }, { contour, {} }, { "smooth", {} } };
  for (const TableRow& row : report.Iterations())
  {
    if (row.Step == step)
    {
      const double x = row.Iteration;
      chart.Lines[0].Points.push_back({ x, row.MeanEnergy });
      chart.Lines[1].Points.push_back({ x, row.MeanPhoto });
      chart.Lines[2].Points.push_back({ x, row.MeanContour });
      chart.Lines[3].Points.push_back({ x, row.MeanSmooth });
    }
  }
  return chart;
}
}

//------------------------------------------------------------------------------
std::string WithRms(const std::string& name, const std::optional<Scores>& scores)
{
  return scores ? name + ", RMS " + Formatted("%.2f", scores->Rms) : name;
}

void AddIterations(ReportPage& page, const RunReport& report, const fs::path& folder)
{
  page.BeginSection("iterations", "Iterations");
  page.AddPlayer("player", IterationFrames(report, folder));
  std::vector<ReportChart> charts;
  if (report.TrueImage())
  {
    charts = { ScoreChart(report, &Scores::Rms, "RMS, grey levels"),
      ScoreChart(report, &Scores::Ssim, "SSIM") };
  }
  std::vector<ReportTable> tables;
  for (const Stage step : { Stage::Outline, Stage::Full })
  {
    tables.push_back(IterationTable(report, step));
    if (!tables.back().Rows.empty())
    {
      charts.push_back(EnergyChart(report, step));
    }
  }
  page.AddCharts(charts);
  for (const ReportTable& table : tables)
  {
    if (!table.Rows.empty())
    {
      page.AddTable(table);
    }
  }
}

Json IterationsJson(const RunReport& report, Stage step)
{
  Json rows = Json::array();
  for (const TableRow& row : report.Iterations())
  {
    if (row.Step == step)
    {
      Json& each = rows.emplace_back(row.Score ? ScoresJson(*row.Score) : Json::object());
      each.update({ { "iteration", row.Iteration }, { "meanEnergy", row.MeanEnergy },
        { "meanPhoto", row.MeanPhoto },
        { step == Stage::Outline ? "meanContour" : "meanHull", row.MeanContour },
        { "meanSmooth", row.MeanSmooth }, { "pointsMoved", row.PointsMoved } });
    }
  }
  return rows;
}
}
