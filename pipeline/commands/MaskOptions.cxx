// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/MaskOptions.h"

#include "base/UsageError.h"
#include "commands/MethodOptions.h"

namespace novelview
{
namespace fs = std::filesystem;

OptionTable OptionsOf(MaskOptions& options)
{
  const char* const mask = "Masks";
  OptionTable table = {
    { "out", "folder for mask/ and the contact sheet", "", mask, &options.Out },
    { "inPlace", "write into the data set's own mask/ instead", "", mask, &options.InPlace },
    { "overwrite", "replace masks that are there", "", mask, &options.Overwrite },
    { "exclude", "photographs to leave out", "", mask, &options.Exclude },
    { "method",
      "alpha channel; plain or dark background; chroma key; GrabCut from a rough box; auto = alpha "
      "channel or, without, plain",
      "", mask, &options.Method, -Unlimited, Unlimited,
      { "auto", "alpha", "plain", "dark", "chroma", "grabcut" } },
    { "key", "background's colour R,G,B for chroma; detected at the border if not given", "levels",
      mask, &options.Key, 0, 255 },
    { "box", "x0,y0,x1,y1 around the object in every photograph, for grabcut", "px", mask,
      &options.Box, -Unlimited, Unlimited },
    { "boxMargin", "the box leaves out this to every side when not given", "part of the frame",
      mask, &options.BoxMargin, 0.01, 0.45 },
    { "grabCutRounds", "rounds of GrabCut", "", mask, &options.GrabCutRounds, 1, 100 },
  };
  AppendOptions(table, OptionsOf(options.Silhouette));
  AppendOptions(table, OptionsOf(options.Source, "format"));
  table.push_back(ThreadsOption(options.Threads));
  return table;
}

MaskOptions MakeMaskOptions(
  const fs::path& dataset, const ParsedArguments& given, const OptionWarning& warn)
{
  MaskOptions options;
  options.Dataset = dataset;
  SetFromArguments(OptionsOf(options), given, warn);
  if (options.Out.empty() == !options.InPlace)
  {
    throw UsageError(options.InPlace ? "--in-place" : "--out",
      options.InPlace ? "cannot be given with --out" : "no folder for the masks given");
  }
  const auto count = [](const std::vector<double>& values, std::size_t wanted, const char* flag)
  {
    if (!values.empty() && values.size() != wanted)
    {
      throw UsageError(flag, "has the wrong length", std::to_string(values.size()) + " numbers",
        std::to_string(wanted));
    }
  };
  count(options.Key, 3, "--key");
  count(options.Box, 4, "--box");
  if (!options.Key.empty() && options.Method != "chroma")
  {
    throw UsageError("--key", "is of no use without --method chroma");
  }
  if (!options.Box.empty() && options.Method != "grabcut")
  {
    throw UsageError("--box", "is of no use without --method grabcut");
  }
  return options;
}
}
