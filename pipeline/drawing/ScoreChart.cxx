// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/ScoreChart.h"

#include "core/PrintableText.h"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace novelview
{
namespace
{
unsigned char Byte(double value)
{
  return static_cast<unsigned char>(std::lround(255 * value));
}

void AddLine(vtkChartXY* chart, const ChartLine& line, const std::string& xName)
{
  vtkNew<vtkDoubleArray> x;
  vtkNew<vtkDoubleArray> y;
  x->SetName(xName.c_str());
  y->SetName(line.Name.c_str());
  for (const auto& [at, value] : line.Points)
  {
    x->InsertNextValue(at);
    y->InsertNextValue(value);
  }
  vtkNew<vtkTable> table;
  table->AddColumn(x);
  table->AddColumn(y);
  // A line of one point is an error to VTK.
  const int type = line.Points.size() > 1 ? vtkChart::LINE : vtkChart::POINTS;
  auto* plot = vtkPlotPoints::SafeDownCast(chart->AddPlot(type));
  plot->SetInputData(table, 0, 1);
  plot->SetColor(Byte(line.Ink[0]), Byte(line.Ink[1]), Byte(line.Ink[2]), 255);
  plot->SetWidth(2.5F);
  plot->SetMarkerStyle(vtkPlotPoints::CIRCLE);
  plot->SetMarkerSize(7);
}

void StyleAxis(vtkAxis* axis, const std::string& title, const ChartStyle& style)
{
  axis->SetTitle(title);
  for (vtkTextProperty* text : { axis->GetTitleProperties(), axis->GetLabelProperties() })
  {
    text->SetFontSize(style.TextSizePx);
    text->SetColor(style.Ink.data());
    text->BoldOff();
  }
  axis->GetPen()->SetColorF(style.Ink[0], style.Ink[1], style.Ink[2]);
  axis->GetGridPen()->SetColorF(style.Grid[0], style.Grid[1], style.Grid[2]);
}

/**
 * Smallest range of the y axis, relative to its values. VTK 9.1 draws no curve in a range of less
 * than a hundredth, and a smaller change cannot be seen in a picture either.
 */
constexpr double MinRelativeRange = 0.02;

/** Whole numbers (or their labels) on the x axis, the values with some air on the y axis. */
void FixRanges(
  vtkChartXY* chart, const std::vector<ChartLine>& lines, const std::vector<std::string>& labels)
{
  double last = 1;
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  for (const ChartLine& line : lines)
  {
    for (const auto& [at, value] : line.Points)
    {
      last = std::max(last, at);
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  if (least > most)
  {
    least = 0;
    most = 1;
  }
  const double smallest = MinRelativeRange * std::max(std::abs(least), std::abs(most));
  const double air = most > least
    ? std::max(0.12 * (most - least), 0.5 * (smallest - (most - least)))
    : 0.05 * std::max(std::abs(most), 1e-3);
  vtkAxis* x = chart->GetAxis(vtkAxis::BOTTOM);
  x->SetBehavior(vtkAxis::FIXED);
  // Labels are wider than numbers, and a legend stands right of the last.
  x->SetRange((labels.empty() ? -0.03 : -0.1) * last, (labels.empty() ? 1.03 : 1.25) * last);
  vtkNew<vtkDoubleArray> ticks;
  vtkNew<vtkStringArray> names;
  const int count = labels.empty() ? static_cast<int>(last) + 1 : static_cast<int>(labels.size());
  const int step =
    std::max(1, static_cast<int>(std::ceil((count - 1) / (labels.empty() ? 10. : 5.))));
  for (int tick = 0; tick < count; tick += step)
  {
    ticks->InsertNextValue(tick);
    if (!labels.empty())
    {
      names->InsertNextValue(ValidUtf8(labels[static_cast<std::size_t>(tick)]));
    }
  }
  x->SetNotation(vtkAxis::PRINTF_NOTATION);
  x->SetLabelFormat("%.0f");
  x->SetCustomTickPositions(ticks, labels.empty() ? nullptr : names.Get());
  vtkAxis* y = chart->GetAxis(vtkAxis::LEFT);
  y->SetBehavior(vtkAxis::FIXED);
  y->SetRange(least - air, most + air);
}
}

//------------------------------------------------------------------------------
ChartPage::ChartPage(const std::string& title)
  : Sheet(Width, Height, this->Paper)
{
  this->Style.Ink = { 0.12, 0.13, 0.16 };
  this->Style.Grid = { 0.86, 0.87, 0.89 };
  this->Style.TextSizePx = 17;
  this->Style.Legend = true;
  this->Sheet.AddText(title, Width / 2, 30, { 22, this->Style.Ink, true, TextStyle::Centre });
}

vtkSmartPointer<vtkChartXY> NewLineChart(
  const std::vector<ChartLine>& lines, const ChartAxis& axis, const ChartStyle& style)
{
  std::vector<ChartLine> shown = lines;
  for (ChartLine& line : shown)
  {
    std::erase_if(line.Points, [](const auto& point) { return !std::isfinite(point[1]); });
  }
  std::erase_if(shown, [](const ChartLine& line) { return line.Points.empty(); });
  auto chart = vtkSmartPointer<vtkChartXY>::New();
  StyleAxis(chart->GetAxis(vtkAxis::BOTTOM), axis.Title, style);
  StyleAxis(chart->GetAxis(vtkAxis::LEFT), style.ScoreName, style);
  for (const ChartLine& line : shown)
  {
    AddLine(chart, line, axis.Title);
  }
  FixRanges(chart, shown, axis.Labels);
  if (style.Legend)
  {
    chart->SetShowLegend(true);
    chart->GetLegend()->SetLabelSize(style.TextSizePx);
    chart->GetLegend()->SetHorizontalAlignment(vtkChartLegend::RIGHT);
    chart->GetLegend()->SetVerticalAlignment(
      style.LegendBelow ? vtkChartLegend::BOTTOM : vtkChartLegend::TOP);
  }
  return chart;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkChartXY> NewScoreChart(
  const std::vector<HistoryRow>& history, const ChartStyle& style)
{
  ChartLine outline{ "outline", colours::Outline, {} };
  ChartLine nonOutline{ "non-outline", colours::NonOutline, {} };
  int lastOutline = 0;
  for (const HistoryRow& row : history)
  {
    const double value = row.*style.Score;
    if (!std::isfinite(value))
    {
      continue;
    }
    if (row.Step == Stage::Outline)
    {
      outline.Points.push_back({ static_cast<double>(row.Iteration), value });
      lastOutline = std::max(lastOutline, row.Iteration);
    }
    else
    {
      nonOutline.Points.push_back({ static_cast<double>(lastOutline + row.Iteration), value });
    }
  }
  return NewLineChart({ outline, nonOutline }, { "iteration" }, style);
}
}
