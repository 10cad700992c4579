// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ViewOptions_h
#define novelview_ViewOptions_h

#include "commands/MethodOptions.h"

#include <string>

namespace novelview
{
/** Novel views in a browser: `novelview view`. */
struct ViewOptions : MethodOptions
{
  int Port = 0;                     ///< 0 = any that is free
  std::string Listen = "127.0.0.1"; ///< address of this computer
  bool Open = true;                 ///< open the page in the user's browser
};

/** The table: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(ViewOptions& options);

/** See MergeOptions(). Throws UsageError. */
ViewOptions MakeViewOptions(const std::filesystem::path& dataset, const ParsedArguments& given,
  const OptionWarning& warn = {});
}

#endif
