// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_RenderOptions_h
#define novelview_RenderOptions_h

#include "commands/MethodOptions.h"

#include <filesystem>

namespace novelview
{
/** Many novel views from one hull and crust: `novelview render`. */
struct RenderOptions : MethodOptions
{
  std::filesystem::path Cameras; ///< calibration file of the views to make
  std::filesystem::path Out;     ///< gets NAME and mask/NAME of each
  /** Of several processes; 0 = never. */
  int RankTimeoutSeconds = ProgramParameters::RankTimeoutSeconds.Default;
};

/** The table: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(RenderOptions& options);

/** See MergeOptions(). Throws UsageError. */
RenderOptions MakeRenderOptions(const std::filesystem::path& dataset, const ParsedArguments& given,
  const OptionWarning& warn = {});
}

#endif
