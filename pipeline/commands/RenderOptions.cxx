// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/RenderOptions.h"

#include "base/UsageError.h"

namespace novelview
{
namespace fs = std::filesystem;

OptionTable OptionsOf(RenderOptions& options)
{
  OptionTable table = {
    { "cameras", "calibration file of the views to make", "", "Render", &options.Cameras },
    { "out", "folder for the pictures NAME and mask/NAME", "", "Render", &options.Out },
  };
  table = WithMethod(std::move(table), options);
  table.push_back(RankTimeoutOption(options.RankTimeoutSeconds));
  return table;
}

RenderOptions MakeRenderOptions(
  const fs::path& dataset, const ParsedArguments& given, const OptionWarning& warn)
{
  RenderOptions options = MergedOptions<RenderOptions>(dataset, given, warn);
  if (options.Cameras.empty())
  {
    throw UsageError("--cameras", "no calibration file of the views given");
  }
  return options;
}
}
