// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_GenerateCommand_h
#define novelview_GenerateCommand_h

#include "base/Console.h"
#include "commands/MethodOptions.h"
#include "generator/Generator.h"
#include "options/Options.h"

#include <filesystem>

namespace novelview
{
/** A data set of virtual photographs: `novelview generate`. */
struct GenerateOptions : GeneratorOptions
{
  std::filesystem::path Out;                        ///< gets the data set
  int Threads = ProgramParameters::Threads.Default; ///< 0 = one per core
  RendererChoice Renderer = RendererChoice::Auto;
};

/** The table: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(GenerateOptions& options);

/** The options; they come from the command line alone, and there is no data set. Throws UsageError. */
GenerateOptions MakeGenerateOptions(const std::filesystem::path& dataset,
  const ParsedArguments& given, const OptionWarning& warn = {});

/** Writes the data set. Throws Error, and Interrupted when the console requests a stop. */
void Generate(const GenerateOptions& options, Console& console);
}

#endif
