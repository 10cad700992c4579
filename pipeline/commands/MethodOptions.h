// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MethodOptions_h
#define novelview_MethodOptions_h

#include "dataset/DatasetInput.h"
#include "drawing/OpenGLLibrary.h"
#include "options/Options.h"
#include "synthesis/SynthesisOptions.h"

#include <filesystem>
#include <string>

namespace novelview
{
/** Options of the program itself. */
struct ProgramParameters
{
  static constexpr Parameter<int> Threads{ 0, 0, 1024 };
  static constexpr Parameter<int> RankTimeoutSeconds{ 300, 0, 86400, "s" };
};

/** The options of every command that makes novel views of a data set. */
struct MethodOptions
{
  DatasetInput Input;
  Stage UpTo = Stage::Full;
  int Threads = ProgramParameters::Threads.Default; ///< 0 = one per core
  RendererChoice Renderer = RendererChoice::Auto;
  SynthesisOptions Synthesis;

  /** The stage options that a preset stands for; a command may have others. */
  static SynthesisOptions DefaultsOf(const std::string& preset) { return PresetOptions(preset); }
};

Option ThreadsOption(int& threads);
Option RendererOption(RendererChoice& renderer);
Option RankTimeoutOption(int& seconds);
Option TextureSizeOption(int& sizePx, const char* group);

/** Appends the options of the method to those of a command. */
OptionTable WithMethod(OptionTable table, MethodOptions& options);

/**
 * Sets the options of a command from what was given: `dataset` is a folder, or a JSON file that holds
 * any of the options ("dataset" among them). The command line overrides the file, which overrides the
 * preset. A preset on the command line replaces all stage options of the file. `warn` receives
 * former names. Throws UsageError, also when there is no data set.
 */
void MergeOptions(const std::filesystem::path& dataset, const ParsedArguments& given,
  const OptionTable& table, SynthesisOptions (*defaultsOf)(const std::string&),
  const OptionWarning& warn, MethodOptions& options);

/** Throws UsageError when there is no place for the results. */
void RequireOut(bool given);

/** The options of a command, merged; see above. */
template <class Options>
Options MergedOptions(
  const std::filesystem::path& dataset, const ParsedArguments& given, const OptionWarning& warn)
{
  Options options;
  MergeOptions(dataset, given, OptionsOf(options), &Options::DefaultsOf, warn, options);
  RequireOut(!options.Out.empty());
  return options;
}
}

#endif
