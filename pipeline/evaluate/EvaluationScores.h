// SPDX-License-Identifier: GPL-3.0-or-later
/** The numbers of an evaluation: means, how much of the gap was closed, and the texts of them. */
#ifndef novelview_EvaluationScores_h
#define novelview_EvaluationScores_h

#include "images/Metrics.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace novelview
{
/** Scores by stage, in the order of the stages: hull, outline, full, oracle. */
using ScoresByStage = std::vector<std::pair<std::string, Scores>>;

/** A predicted view. */
struct EvaluatedView
{
  std::string Name;
  std::size_t References = 0; ///< photographs it was predicted from
  ScoresByStage Stages;
};

/** Of the way from the hull's score to the oracle's, the part that the full stage goes; 1 = all. */
struct GapClosure
{
  double Rms = 0;
  double Ssim = 0;
};

/** The scores of a stage; null when there are none. */
const Scores* FindStage(const ScoresByStage& stages, const std::string& name);

/** The arithmetic mean of every score over the views, by stage; also that of PSNR, in dB. */
ScoresByStage MeanScores(const std::vector<EvaluatedView>& views);

/**
 * (hull - full) / (hull - oracle); nothing when one of the three is missing. Not finite when the
 * hull is as good as the oracle.
 */
std::optional<GapClosure> ClosureOf(const ScoresByStage& stages);

/** The views whose full stage has a larger RMS than their hull. */
std::vector<std::string> WorseThanHull(const std::vector<EvaluatedView>& views);

/** An aligned table, a string per line: every view and stage, the means, the gap closure. */
std::vector<std::string> ScoreTable(const std::vector<EvaluatedView>& views);

/** view,stage,rms,psnr,ssim,iou,missing,excess; every number reads back as the same bits. */
std::string ScoresCsv(const std::vector<EvaluatedView>& views);

/** The keys views, mean, gap_closure (when known) and worse_than_hull. */
nlohmann::ordered_json EvaluationJson(const std::vector<EvaluatedView>& views);
}

#endif
