// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/EvaluationPictures.h"

#include "ViewAccess.h"
#include "base/NumberText.h"
#include "drawing/Canvas.h"
#include "drawing/ErrorPicture.h"
#include "drawing/ScoreChart.h"
#include "images/ImageFile.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
constexpr int NameWidth = 150;
constexpr int BarWidth = 72;
constexpr int MaxWidth = 400; ///< of an image on the contact sheet
constexpr int MaxHeight = 240;
constexpr int MaxSheetHeight =
  8000; ///< height of the contact sheet: half of what the driver can do
constexpr double ErrorRange = 80;

Colour InkOf(const std::string& stage)
{
  if (stage == "outline")
  {
    return colours::Outline;
  }
  if (stage == "full")
  {
    return colours::NonOutline;
  }
  return stage == "oracle" ? Colour{ 0.30, 0.65, 0.35 } : Colour{ 0.55, 0.57, 0.62 };
}
}

//------------------------------------------------------------------------------
class Overview::Internals
{
public:
  Internals(const std::string& lastStage, std::size_t rows, double aspect)
    : Cell(CellFor(static_cast<int>(rows), aspect))
    , WithLast(lastStage != "hull")
    , Table(HeatColours(ErrorRange))
    , Sheet(this->ColumnX(this->Columns()) + BarWidth,
        TitleHeight + HeaderHeight + static_cast<int>(rows) * (this->Cell.Height + Gap) + Gap,
        colours::Desktop)
  {
  }

  /** The largest image such that all rows fit. */
  static Box CellFor(int rows, double aspect)
  {
    const int room = (MaxSheetHeight - TitleHeight - HeaderHeight) / std::max(rows, 1) - Gap;
    Box cell;
    cell.Height =
      std::clamp(static_cast<int>(MaxWidth / aspect), 8, std::max(8, std::min(MaxHeight, room)));
    cell.Width = std::clamp(static_cast<int>(std::lround(cell.Height * aspect)), 8, MaxWidth);
    return cell;
  }
  int Columns() const { return this->WithLast ? 4 : 3; }
  int ColumnX(int column) const { return Gap + NameWidth + column * (this->Cell.Width + Gap); }

  void AddHeadings(const std::string& title, const std::string& lastStage)
  {
    this->Sheet.AddText(title, Gap, TitleHeight / 2, { 19, colours::Text, true });
    std::vector<std::string> names{ "truth", "hull" };
    if (this->WithLast)
    {
      names.push_back(lastStage);
    }
    names.push_back("error of " + lastStage);
    for (std::size_t column = 0; column < names.size(); ++column)
    {
      this->Sheet.AddText(names[column],
        this->ColumnX(static_cast<int>(column)) + this->Cell.Width / 2,
        TitleHeight + HeaderHeight / 2, { 15, colours::FaintText, false, TextStyle::Centre });
    }
  }

  void AddRow(const OverviewRow& row)
  {
    Box box = this->Cell;
    box.Y = TitleHeight + HeaderHeight + this->Row * (this->Cell.Height + Gap);
    const int middle = box.Y + box.Height / 2;
    this->Sheet.AddText(row.Name, Gap, middle - 20, { 14, colours::Text });
    this->Sheet.AddText(
      "hull RMS " + Formatted("%.2f", row.HullRms), Gap, middle, { 13, colours::FaintText });
    if (this->WithLast)
    {
      this->Sheet.AddText("RMS " + Formatted("%.2f", row.LastRms), Gap, middle + 18,
        { 13, row.LastRms > row.HullRms ? colours::Outline : colours::FaintText });
    }
    std::vector<vtkImageData*> pictures{ row.Truth, row.Hull };
    if (this->WithLast)
    {
      pictures.push_back(row.Last);
    }
    const auto error = ErrorPicture(row.Last, row.Truth, this->Table);
    pictures.push_back(error);
    for (std::size_t column = 0; column < pictures.size(); ++column)
    {
      box.X = this->ColumnX(static_cast<int>(column));
      this->Sheet.AddPicture(pictures[column], box);
    }
    if (this->Row == 0)
    {
      this->Sheet.AddColourBar(
        this->Table, { box.X + box.Width + Gap, box.Y, BarWidth - Gap, box.Height }, "%.0f");
    }
    ++this->Row;
  }

  const Box Cell;
  const bool WithLast;
  const vtkSmartPointer<vtkColorTransferFunction> Table;
  Canvas Sheet;
  int Row = 0;
};

//------------------------------------------------------------------------------
Overview::Overview(
  const std::string& title, const std::string& lastStage, std::size_t rows, double aspect)
  : Impl(std::make_unique<Internals>(lastStage, rows, aspect))
{
  this->Impl->AddHeadings(title, lastStage);
}

Overview::~Overview() = default;

void Overview::AddRow(const OverviewRow& row)
{
  this->Impl->AddRow(row);
}

void Overview::Write(const std::filesystem::path& path)
{
  WriteArray(path, this->Impl->Sheet.Draw(), arrays::Color);
}

//------------------------------------------------------------------------------
void DrawEvaluationChart(const std::string& title, const std::vector<EvaluatedView>& views,
  const std::filesystem::path& path)
{
  ChartPage page(title);
  ChartAxis axis{ "view", {} };
  for (const EvaluatedView& view : views)
  {
    axis.Labels.push_back(std::filesystem::path(view.Name).stem().string());
  }
  const auto draw = [&](double Scores::*score, const std::string& name, int x)
  {
    std::vector<ChartLine> lines;
    for (const auto& [stage, first] : views.front().Stages)
    {
      ChartLine& line = lines.emplace_back(ChartLine{ stage, InkOf(stage), {} });
      for (std::size_t i = 0; i < views.size(); ++i)
      {
        line.Points.push_back(
          { static_cast<double>(i), FindStage(views[i].Stages, stage)->*score });
      }
    }
    ChartStyle style = page.Style;
    style.ScoreName = name;
    page.Sheet.AddChart(NewLineChart(lines, axis, style),
      { x, 56, ChartPage::Width / 2 - 20, ChartPage::Height - 66 }, page.Paper);
  };
  draw(&Scores::Rms, "RMS, grey levels", 10);
  draw(&Scores::Ssim, "SSIM", ChartPage::Width / 2 + 10);
  WriteArray(path, page.Sheet.Draw(), arrays::Color);
}
}
