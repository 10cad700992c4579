// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/MethodOptions.h"

#include "base/UsageError.h"
#include "texture/TextureAtlasOptions.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace novelview
{
namespace fs = std::filesystem;

Option ThreadsOption(int& threads)
{
  // The result is the same with any number, so a written job does not hold it.
  Option option = ParameterOption(
    "threads", "threads to use; 0 = one per core", "Program", &threads, ProgramParameters::Threads);
  option.InJob = false;
  return option;
}

Option RendererOption(RendererChoice& renderer)
{
  static const std::vector<std::pair<std::string, RendererChoice>> words = {
    { "auto", RendererChoice::Auto }, { "osmesa", RendererChoice::OSMesa },
    { "egl", RendererChoice::Egl }, { "egl-gpu", RendererChoice::EglGpu }
  };
  WordTarget target{ "NAME", "auto, osmesa, egl, egl-gpu", {}, {} };
  target.Set = [&renderer, range = target.Range](
                 const std::string& word, const std::string& where, const PathMap&)
  {
    const auto found = std::find_if(
      words.begin(), words.end(), [&word](const auto& each) { return each.first == word; });
    if (found == words.end())
    {
      throw UsageError(where, "is not a renderer", "'" + word + "'", range);
    }
    renderer = found->second;
  };
  target.Get = [&renderer](const PathMap&)
  {
    return std::find_if(
      words.begin(), words.end(), [&renderer](const auto& each) { return each.second == renderer; })
      ->first;
  };
  Option option{ "renderer",
    "OpenGL for pictures of scenes and charts: OSMesa, EGL's software device (auto = the first of "
    "them that is installed), or EGL's first graphics card",
    "", "Program", target };
  option.InJob = false;
  return option;
}

Option RankTimeoutOption(int& seconds)
{
  Option option = ParameterOption("rankTimeout",
    "end the run of several processes (mpirun) when one of them is silent for this long; 0 = never",
    "Program", &seconds, ProgramParameters::RankTimeoutSeconds);
  option.InJob = false;
  return option;
}

Option TextureSizeOption(int& sizePx, const char* group)
{
  return ParameterOption("textureSize", "largest side of a mesh's texture", group, &sizePx,
    TextureAtlasOptions::LargestSidePxParameter);
}

OptionTable WithMethod(OptionTable table, MethodOptions& options)
{
  table.push_back(StageOption(options.UpTo));
  AppendOptions(table, OptionsOf(options.Synthesis));
  AppendOptions(table, OptionsOf(options.Input));
  table.push_back(ThreadsOption(options.Threads));
  table.push_back(RendererOption(options.Renderer));
  return table;
}

void MergeOptions(const fs::path& dataset, const ParsedArguments& given, const OptionTable& table,
  SynthesisOptions (*defaultsOf)(const std::string&), const OptionWarning& warn,
  MethodOptions& options)
{
  const auto applyPreset = [&](const std::string& preset)
  {
    SetFromText(FindOption(table, "preset"), { preset }); // throws when there is none of this name
    options.Synthesis = defaultsOf(preset);
  };
  applyPreset(std::string(options.Synthesis.Preset));
  std::error_code failure;
  if (fs::is_regular_file(dataset, failure))
  {
    const nlohmann::ordered_json object = ReadJsonObject(dataset);
    if (object.contains("preset"))
    {
      const OptionTable preset{ FindOption(table, "preset") };
      SetFromJson(preset, { { "preset", object["preset"] } }, {}, dataset.string());
      applyPreset(std::string(options.Synthesis.Preset));
    }
    SetFromJson(table, object, fs::absolute(dataset).parent_path(), dataset.string(), warn);
  }
  else
  {
    options.Input.Dataset = dataset;
  }
  for (const auto& [key, words] : given)
  {
    if (key == "preset" && words.size() == 1)
    {
      applyPreset(words.front());
    }
  }
  SetFromArguments(table, given, warn);
  if (options.Input.Dataset.empty())
  {
    throw UsageError(dataset.empty() ? "data set" : dataset.string(), "no data set given");
  }
}

void RequireOut(bool given)
{
  if (!given)
  {
    throw UsageError("--out", "no place for the results given");
  }
}
}
