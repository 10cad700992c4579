// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/RunOptions.h"

#include "base/JsonFile.h"
#include "base/UsageError.h"
#include "core/PrintableText.h"
#include "mesh/ModelFile.h"

namespace novelview
{
namespace fs = std::filesystem;

OptionTable OptionsOf(RunOptions& options)
{
  const char* const run = "Run";
  OptionTable table = {
    { "view", "novel view: between:A,B[,FRACTION], like:IMAGE or file:PAR.txt#NAME", "", run,
      ViewTarget(options.View) },
    { "out", "folder for the results", "", run, &options.Out },
    { "truth", "true picture of the novel view, to compare with", "", run, &options.Truth },
    { "truthMask", "silhouette of the true picture", "", run, &options.TruthMask },
    { "trueMesh", "true mesh, for the oracle: an upper bound for any geometry", "", run,
      &options.TrueMesh },
    { "iterations", "write picture, mesh and scores of every iteration", "", run,
      &options.WriteIterations },
    { "screenshots", "write a picture of the scene for every iteration, too", "", run,
      &options.Screenshots },
    { "report", "write report.html, a page with everything about the run, and rig.png", "", run,
      &options.Page },
    { "meshOut", "also write the view's mesh with its texture: " + ModelFileKinds(), "", run,
      &options.MeshOut },
    TextureSizeOption(options.TextureSizePx, run),
  };
  return WithMethod(std::move(table), options);
}

namespace
{
/** The job file that is written into the out folder. */
nlohmann::ordered_json JsonOf(const RunOptions& options)
{
  RunOptions copy = options;
  copy.Out = (fs::absolute(options.Out) / "job.json").parent_path();
  return ToJson(OptionsOf(copy), copy.Out);
}

/** job.json must name every file exactly, which is found out before the work. */
void CheckNames(const RunOptions& options)
{
  const nlohmann::ordered_json object = JsonOf(options);
  for (const auto& [key, value] : object.items())
  {
    const auto check = [&key = key](const nlohmann::ordered_json& each)
    {
      if (each.is_string() && !IsUtf8(each.get_ref<const std::string&>()))
      {
        throw Error(key, "is not UTF-8, so that the job.json of the results cannot name it",
          each.get_ref<const std::string&>(), "another name");
      }
    };
    check(value);
    for (const nlohmann::ordered_json& each : value.is_array() ? value : nlohmann::ordered_json())
    {
      check(each);
    }
  }
}
}

RunOptions MakeRunOptions(
  const fs::path& dataset, const ParsedArguments& given, const OptionWarning& warn)
{
  RunOptions options = MergedOptions<RunOptions>(dataset, given, warn);
  if (options.View.What == ViewSpec::Kind::None)
  {
    throw UsageError("--view", "no novel view given");
  }
  if (options.Truth.empty() && !options.TruthMask.empty())
  {
    throw UsageError("--truth-mask", "is of no use without --truth");
  }
  CheckModelFiles(options.MeshOut, "--mesh-out");
  CheckNames(options);
  return options;
}

std::string JobText(const RunOptions& options)
{
  return DumpJson(JsonOf(options)) + "\n";
}
}
