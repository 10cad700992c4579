// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_EvaluateOptions_h
#define novelview_EvaluateOptions_h

#include "commands/MethodOptions.h"
#include "evaluate/EvaluationPlan.h"

#include <filesystem>

namespace novelview
{
/** Novel views against photographs that no stage saw: `novelview evaluate`. */
struct EvaluateOptions
  : MethodOptions
  , HoldOutOptions
{
  std::filesystem::path Out; ///< gets the scores, the chart and the images
  bool Pictures = true;      ///< write the views' images and the overview
  bool Page = true;          ///< write report.html
  /** Of several processes; 0 = never. */
  int RankTimeoutSeconds = ProgramParameters::RankTimeoutSeconds.Default;
};

/** The table: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(EvaluateOptions& options);

/** See MergeOptions(). Throws UsageError. */
EvaluateOptions MakeEvaluateOptions(const std::filesystem::path& dataset,
  const ParsedArguments& given, const OptionWarning& warn = {});
}

#endif
