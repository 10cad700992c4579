// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_EvaluationPage_h
#define novelview_EvaluationPage_h

#include "evaluate/EvaluationScores.h"
#include "report/ReportPage.h"

#include <nlohmann/json.hpp>

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>

#include <string>
#include <utility>
#include <vector>

namespace novelview
{
/** The images of one predicted view, small enough for a page. */
struct EvaluationShots
{
  std::string Name;
  std::vector<ReportPicture> Pictures;
};

/** Embeds the images of a view: every stage's, the truth, and the error of the last stage. */
EvaluationShots ShotsOf(const std::string& name,
  const std::vector<std::pair<std::string, vtkImageData*>>& stages, vtkImageData* truth);

struct EvaluationPageInput
{
  std::string Title;
  nlohmann::ordered_json Summary; ///< contents of scores.json
  nlohmann::ordered_json Timings; ///< as Console::TimingsText() has them
};

/**
 * report.html of an evaluation: means, the scores of every view and stage as tables and charts, the
 * views' images with sliders, the photographs, timings and options.
 */
std::string EvaluationPageHtml(const EvaluationPageInput& input,
  const std::vector<EvaluatedView>& views, const std::vector<EvaluationShots>& shots,
  vtkMultiBlockDataSet* photographs);
}

#endif
