// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the pipeline's pictures: a score over the iterations.
#ifndef novelview_ScoreChart_h
#define novelview_ScoreChart_h

#include "Canvas.h"
#include "ScenePictures.h"

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

/**
 * The outline iterations followed by the non-outline ones, a line each, joined at the last outline
 * iteration. Rows whose score is not finite are left out.
 */
vtkSmartPointer<vtkChartXY> NewScoreChart(
  const std::vector<HistoryRow>& history, const ChartStyle& style);
}

#endif
