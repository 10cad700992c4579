// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/CheckOptions.h"

#include "commands/MethodOptions.h"

namespace novelview
{
namespace fs = std::filesystem;

OptionTable OptionsOf(CheckOptions& options)
{
  OptionTable table = {
    { "out", "folder for check.json and cameras.png; neither is written when not given", "",
      "Check", &options.Out },
  };
  AppendOptions(table, OptionsOf(options.Input));
  table.push_back(ThreadsOption(options.Threads));
  table.push_back(RendererOption(options.Renderer));
  return table;
}

CheckOptions MakeCheckOptions(
  const fs::path& dataset, const ParsedArguments& given, const OptionWarning& warn)
{
  CheckOptions options;
  options.Input.Dataset = dataset;
  SetFromArguments(OptionsOf(options), given, warn);
  return options;
}
}
