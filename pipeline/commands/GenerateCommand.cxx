// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/GenerateCommand.h"

#include "base/UsageError.h"
#include "commands/MethodOptions.h"

namespace novelview
{
OptionTable OptionsOf(GenerateOptions& options)
{
  OptionTable table = { { "out", "folder for the data set", "", "Generate", &options.Out },
    ThreadsOption(options.Threads), RendererOption(options.Renderer) };
  AppendOptions(table, OptionsOf(static_cast<GeneratorOptions&>(options)));
  return table;
}

GenerateOptions MakeGenerateOptions(
  const std::filesystem::path& /*dataset*/, const ParsedArguments& given, const OptionWarning& warn)
{
  GenerateOptions options;
  SetFromArguments(OptionsOf(options), given, warn);
  RequireOut(!options.Out.empty());
  return options;
}

void Generate(const GenerateOptions& options, Console& console)
{
  GenerateDataset(options, options.Out,
    [&console](const std::string& what, double fraction)
    { return console.Progress(what, fraction); });
  console.Info("data set written to " + options.Out.string());
  console.Summary();
}
}
