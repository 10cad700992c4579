// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/EvaluateOptions.h"

#include "base/UsageError.h"

namespace novelview
{
namespace fs = std::filesystem;

OptionTable OptionsOf(EvaluateOptions& options)
{
  const char* const evaluate = "Evaluate";
  OptionTable table = {
    { "out", "folder for scores, chart and pictures", "", evaluate, &options.Out },
    { "holdOut", "photographs to leave out and predict, all at once", "", evaluate,
      &options.HoldOut },
    { "every", "leave out and predict photographs 0, K, 2K .., all at once; 0 = not so", "",
      evaluate, &options.Every, 0, Unlimited },
    { "leaveOneOut", "predict each photograph from all others; else the data set's test views", "",
      evaluate, &options.LeaveOneOut },
    { "trueMesh",
      "true mesh, for the oracle: an upper bound for any geometry; truth.ply beside test views is "
      "detected",
      "", evaluate, &options.TrueMesh },
    { "pictures", "write the picture of every view and stage, and an overview", "", evaluate,
      &options.Pictures },
    { "report", "write report.html, a page with everything about the evaluation", "", evaluate,
      &options.Page },
  };
  table = WithMethod(std::move(table), options);
  table.push_back(RankTimeoutOption(options.RankTimeoutSeconds));
  return table;
}

EvaluateOptions MakeEvaluateOptions(
  const fs::path& dataset, const ParsedArguments& given, const OptionWarning& warn)
{
  EvaluateOptions options = MergedOptions<EvaluateOptions>(dataset, given, warn);
  std::vector<std::string> ways;
  if (!options.HoldOut.empty())
  {
    ways.push_back("--hold-out");
  }
  if (options.Every > 0)
  {
    ways.push_back("--every");
  }
  if (options.LeaveOneOut)
  {
    ways.push_back("--leave-one-out");
  }
  if (ways.size() > 1)
  {
    throw UsageError(ways[1], "cannot be given with " + ways[0]);
  }
  if (options.Every == 1)
  {
    throw UsageError("--every", "leaves no photograph to predict from", "1", "at least 2");
  }
  for (const std::string& name : options.HoldOut)
  {
    if (std::count(options.HoldOut.begin(), options.HoldOut.end(), name) > 1)
    {
      throw UsageError("--hold-out", "names a photograph twice: " + name);
    }
    if (std::count(options.Input.Exclude.begin(), options.Input.Exclude.end(), name) > 0)
    {
      throw UsageError("--hold-out", "names a photograph that --exclude leaves out: " + name);
    }
  }
  return options;
}
}
