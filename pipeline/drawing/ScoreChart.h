// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the pipeline's images: a score over the iterations, or over whatever is counted.
#ifndef novelview_ScoreChart_h
#define novelview_ScoreChart_h

#include "drawing/Canvas.h"
#include "drawing/ScenePictures.h"

#include <array>
#include <string>
#include <vector>

namespace novelview
{
/** What a chart shows and how. */
struct ChartStyle
{
  double HistoryRow::*Score = &HistoryRow::Rms;
  std::string ScoreName = "RMS";
  Colour Ink = colours::Text; ///< of axes and text
  Colour Grid = { 0.22, 0.24, 0.28 };
  int TextSizePx = 13;
  bool Legend = false;
  bool LegendBelow = false; ///< in the lower right corner instead of the upper right one
};

/** A white page with a title, for charts to be read on paper. */
struct ChartPage
{
  static constexpr int Width = 1600;
  static constexpr int Height = 700;

  explicit ChartPage(const std::string& title);

  Colour Paper = { 1, 1, 1 };
  ChartStyle Style; ///< of its charts
  Canvas Sheet;
};

/** A line of a chart. */
struct ChartLine
{
  std::string Name;
  Colour Ink;
  std::vector<std::array<double, 2>> Points; ///< x, y; points that are not finite are left out
};

/** What the x axis is called, and what stands at 0, 1, 2 ..; numbers when there are no labels. */
struct ChartAxis
{
  std::string Title;
  std::vector<std::string> Labels = {};
};

/** Lines over a common x axis of whole numbers from 0; the style's score names the y axis. */
vtkSmartPointer<vtkChartXY> NewLineChart(
  const std::vector<ChartLine>& lines, const ChartAxis& axis, const ChartStyle& style);

/**
 * The outline iterations followed by the non-outline ones, a line each, joined at the last outline
 * iteration. Rows whose score is not finite are left out.
 */
vtkSmartPointer<vtkChartXY> NewScoreChart(
  const std::vector<HistoryRow>& history, const ChartStyle& style);
}

#endif
