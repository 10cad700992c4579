// SPDX-License-Identifier: GPL-3.0-or-later
#include "ScoreChart.h"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkDoubleArray.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
/** x and y of one line. */
struct Series
{
  std::string Name;
  Colour Ink;
  vtkNew<vtkDoubleArray> X;
  vtkNew<vtkDoubleArray> Y;

  void Add(double x, double y)
  {
    this->X->InsertNextValue(x);
    this->Y->InsertNextValue(y);
  }
};

unsigned char Byte(double value)
{
  return static_cast<unsigned char>(std::lround(255 * value));
}

void AddLine(vtkChartXY* chart, Series& series)
{
  series.X->SetName("iteration");
  series.Y->SetName(series.Name.c_str());
  vtkNew<vtkTable> table;
  table->AddColumn(series.X);
  table->AddColumn(series.Y);
  // A line of one point is an error to VTK.
  const int type = series.X->GetNumberOfTuples() > 1 ? vtkChart::LINE : vtkChart::POINTS;
  auto* line = vtkPlotPoints::SafeDownCast(chart->AddPlot(type));
  line->SetInputData(table, 0, 1);
  line->SetColor(Byte(series.Ink[0]), Byte(series.Ink[1]), Byte(series.Ink[2]), 255);
  line->SetWidth(2.5F);
  line->SetMarkerStyle(vtkPlotPoints::CIRCLE);
  line->SetMarkerSize(7);
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

/** Whole iterations on the x axis, the values with some air on the y axis. */
void FixRanges(vtkChartXY* chart, const Series& first, const Series& second)
{
  double last = 1;
  double least = VTK_DOUBLE_MAX;
  double most = VTK_DOUBLE_MIN;
  for (const Series* series : { &first, &second })
  {
    for (vtkIdType i = 0; i < series->X->GetNumberOfTuples(); ++i)
    {
      last = std::max(last, series->X->GetValue(i));
      least = std::min(least, series->Y->GetValue(i));
      most = std::max(most, series->Y->GetValue(i));
    }
  }
  if (least > most)
  {
    least = 0;
    most = 1;
  }
  const double air = most > least ? 0.12 * (most - least) : 0.05 * std::max(std::abs(most), 1e-3);
  vtkAxis* x = chart->GetAxis(vtkAxis::BOTTOM);
  x->SetBehavior(vtkAxis::FIXED);
  x->SetRange(-0.03 * last, 1.03 * last);
  vtkNew<vtkDoubleArray> ticks;
  const int step = std::max(1, static_cast<int>(std::ceil(last / 10)));
  for (int tick = 0; tick <= last; tick += step)
  {
    ticks->InsertNextValue(tick);
  }
  x->SetNotation(vtkAxis::PRINTF_NOTATION);
  x->SetLabelFormat("%.0f");
  x->SetCustomTickPositions(ticks);
  vtkAxis* y = chart->GetAxis(vtkAxis::LEFT);
  y->SetBehavior(vtkAxis::FIXED);
  y->SetRange(least - air, most + air);
}
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkChartXY> NewScoreChart(
  const std::vector<HistoryRow>& history, const ChartStyle& style)
{
  Series outline{ "outline", colours::Outline, {}, {} };
  Series nonOutline{ "non-outline", colours::NonOutline, {}, {} };
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
      outline.Add(row.Iteration, value);
      lastOutline = std::max(lastOutline, row.Iteration);
    }
    else
    {
      nonOutline.Add(lastOutline + row.Iteration, value);
    }
  }
  auto chart = vtkSmartPointer<vtkChartXY>::New();
  StyleAxis(chart->GetAxis(vtkAxis::BOTTOM), "iteration", style);
  StyleAxis(chart->GetAxis(vtkAxis::LEFT), style.ScoreName, style);
  for (Series* series : { &outline, &nonOutline })
  {
    if (series->X->GetNumberOfTuples() > 0)
    {
      AddLine(chart, *series);
    }
  }
  FixRanges(chart, outline, nonOutline);
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
}
