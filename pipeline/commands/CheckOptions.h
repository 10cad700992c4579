// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CheckOptions_h
#define novelview_CheckOptions_h

#include "commands/MethodOptions.h"
#include "dataset/DatasetInput.h"
#include "options/Options.h"

#include <filesystem>

namespace novelview
{
/** What is wrong with a data set: `novelview check`. */
struct CheckOptions
{
  DatasetInput Input;
  std::filesystem::path Out; ///< gets check.json and the image of the cameras; empty = neither
  int Threads = ProgramParameters::Threads.Default;
  RendererChoice Renderer = RendererChoice::Auto;
};

/** The table: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(CheckOptions& options);

/** The options of a check; they come from the command line alone. Throws UsageError. */
CheckOptions MakeCheckOptions(const std::filesystem::path& dataset, const ParsedArguments& given,
  const OptionWarning& warn = {});
}

#endif
