// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/ViewOptions.h"

namespace novelview
{
namespace fs = std::filesystem;

OptionTable OptionsOf(ViewOptions& options)
{
  const char* const view = "View";
  OptionTable table = {
    { "port", "port of the page; 0 = any that is free", "", view, &options.Port, 0, 65535 },
    { "listen", "address of the page; other than the default, other computers can reach it", "",
      view, &options.Listen },
    { "open", "open the page in the browser, where there is a display", "", view, &options.Open },
  };
  return WithMethod(std::move(table), options);
}

ViewOptions MakeViewOptions(
  const fs::path& dataset, const ParsedArguments& given, const OptionWarning& warn)
{
  ViewOptions options;
  MergeOptions(dataset, given, OptionsOf(options), &ViewOptions::DefaultsOf, warn, options);
  return options;
}
}
