// SPDX-License-Identifier: GPL-3.0-or-later
/** The images of an evaluation: a contact sheet of the views, and a chart of their scores. */
#ifndef novelview_EvaluationPictures_h
#define novelview_EvaluationPictures_h

#include "evaluate/EvaluationScores.h"

#include <vtkImageData.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace novelview
{
/** What a row of the contact sheet shows; not owned, arrays Color and Mask, all of one size. */
struct OverviewRow
{
  std::string Name;
  vtkImageData* Truth = nullptr;
  vtkImageData* Hull = nullptr;
  vtkImageData* Last = nullptr; ///< of the last stage
  double HullRms = 0;
  double LastRms = 0;
};

/**
 * A row per view: truth, hull, last stage, and the error of the last stage. Images are scaled
 * down as they are added, so that many large ones do not stay in memory; with many rows they are
 * smaller, down to what a window can contain.
 */
class Overview
{
public:
  /** `aspect` is the views' width over height; `lastStage` heads the third column. */
  Overview(const std::string& title, const std::string& lastStage, std::size_t rows, double aspect);
  ~Overview();

  void AddRow(const OverviewRow& row);
  void Write(const std::filesystem::path& path);

private:
  class Internals;
  std::unique_ptr<Internals> Impl;
};

/** RMS and SSIM of every stage over the views as line charts, 1600 x 700. */
void DrawEvaluationChart(const std::string& title, const std::vector<EvaluatedView>& views,
  const std::filesystem::path& path);
}

#endif
