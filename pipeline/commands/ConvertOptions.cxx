// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/ConvertOptions.h"

#include "base/UsageError.h"
#include "commands/MethodOptions.h"
#include "formats/DatasetFormats.h"

namespace novelview
{
namespace fs = std::filesystem;

OptionTable OptionsOf(ConvertOptions& options)
{
  const char* const convert = "Convert";
  OptionTable table = {
    { "out", "folder for the new data set", "", convert, &options.Out },
    { "format", "format to write", "", convert, &options.Format, -Unlimited, Unlimited,
      WritableFormatNames() },
    { "exclude", "photographs to leave out", "", convert, &options.Exclude },
    { "refineCameras", "write the poses that preset best refines, where photographs agree better",
      "", convert, &options.RefineCameras },
    { "undistort", "undistort photographs also where the format can represent the distortion", "",
      convert, &options.Undistort },
  };
  table.front().Positional = true;
  AppendOptions(table, OptionsOf(options.Source, "from"));
  table.push_back(ThreadsOption(options.Threads));
  return table;
}

ConvertOptions MakeConvertOptions(
  const fs::path& dataset, const ParsedArguments& given, const OptionWarning& warn)
{
  ConvertOptions options;
  options.Dataset = dataset;
  SetFromArguments(OptionsOf(options), given, warn);
  if (options.Format.empty())
  {
    throw UsageError("--format", "no format to write given", "nothing",
      RangeText(FindOption(OptionsOf(options), "format")));
  }
  return options;
}
}
