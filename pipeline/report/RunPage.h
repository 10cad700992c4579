// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_RunPage_h
#define novelview_RunPage_h

#include "geometry/Camera.h"
#include "report/ReportPage.h"
#include "report/RunReport.h"

#include <nlohmann/json.hpp>

#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>

#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/** Contents of the page of a run in addition to the files that the run has written; not owned. */
struct RunPageInput
{
  std::string Title;
  std::filesystem::path Folder;          ///< of the results, with all files but the page
  const RunReport* Report = nullptr;     ///< finished
  vtkMultiBlockDataSet* Views = nullptr; ///< the photographs used
  nlohmann::ordered_json Job;            ///< contents of job.json
  nlohmann::ordered_json Timings;        ///< as Console::TimingsText() has them
  std::vector<std::string> Warnings;
  Camera Novel;
  vtkPolyData* TrueMesh = nullptr; ///< null when there is none
};

/**
 * report.html of a run: what went in, the stages side by side, the iterations as a player (at most
 * 60 of them with images, evenly chosen), the same in the form of the paper, tables, charts, timings
 * and the job. The file depends on
 * nothing beside it.
 */
std::string RunPageHtml(const RunPageInput& input);

// ---- what pages of other commands share -------------------------------------------------------

/** The scores of some stages as rows: name, RMS, PSNR, SSIM, IoU, missing, excess. */
std::vector<std::string> ScoreColumns(const std::string& first);
std::vector<ReportCell> ScoreRow(const std::string& name, const std::optional<Scores>& scores);

/** Sections "How long it took" and "About this run". */
void AddTimings(ReportPage& page, const nlohmann::ordered_json& timings);
void AddAbout(ReportPage& page, const nlohmann::ordered_json& job, const std::string& renderer);

/** Key, text with unit: "RMS", "12.34". */
std::vector<std::pair<std::string, std::string>> ScoreTiles(const Scores& scores);
}

#endif
