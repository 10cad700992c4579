// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/Command.h"

#include "base/Parallel.h"
#include "commands/CheckCommand.h"
#include "commands/ConvertCommand.h"
#include "commands/EvaluateCommand.h"
#include "commands/GenerateCommand.h"
#include "commands/MaskCommand.h"
#include "commands/MeshCommand.h"
#include "commands/OrbitCommand.h"
#include "commands/RenderCommand.h"
#include "commands/RunCommand.h"
#include "commands/ViewCommand.h"

#include <type_traits>

namespace novelview
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* FolderHelp = "folder of the photographs";
constexpr const char* JobHelp =
  "folder of the photographs, or a JSON job file with any of the options";

template <class Options>
Options DefaultsOf()
{
  Options options;
  if constexpr (std::is_base_of_v<MethodOptions, Options>)
  {
    options.Synthesis = Options::DefaultsOf(options.Synthesis.Preset);
  }
  return options;
}

template <class Options>
void ShowOptions(const std::function<void(const OptionTable&)>& show)
{
  Options defaults = DefaultsOf<Options>();
  show(OptionsOf(defaults));
}

OptionWarning WarnOn(Console& console)
{
  return [&console](const std::string& text) { console.Warn(text); };
}

/** Threads and renderer count for the whole process. */
template <class Options>
void ApplyToProgram(const Options& options)
{
  LimitThreads(options.Threads);
  if constexpr (requires { options.Renderer; })
  {
    ChooseRenderer(options.Renderer);
  }
}

/** A command of this process alone; `work` may return whether there are no problems. */
template <class Options, class Result>
Command Single(const char* name, const char* help, const char* datasetHelp,
  Options (*make)(const fs::path&, const ParsedArguments&, const OptionWarning&),
  Result (*work)(const Options&, Console&))
{
  const auto run = [make, work](
                     const fs::path& dataset, const ParsedArguments& given, CommandContext& context)
  {
    const Options options = make(dataset, given, WarnOn(context.Out));
    ApplyToProgram(options);
    if constexpr (std::is_same_v<Result, bool>)
    {
      return work(options, context.Out) ? ExitCode::Ok : ExitCode::Problems;
    }
    else
    {
      work(options, context.Out);
      return ExitCode::Ok;
    }
  };
  return { name, help, datasetHelp, false, ShowOptions<Options>, run };
}

/** A command that the processes of mpirun share. */
template <class Options>
Command Shared(const char* name, const char* help,
  Options (*make)(const fs::path&, const ParsedArguments&, const OptionWarning&),
  void (*work)(const Options&, Console&, ProcessGroup&))
{
  const auto run = [make, work](
                     const fs::path& dataset, const ParsedArguments& given, CommandContext& context)
  {
    const Options options = make(dataset, given, WarnOn(context.Out));
    ApplyToProgram(options);
    work(options, context.Out, context.StartProcesses(options.RankTimeoutSeconds));
    return ExitCode::Ok;
  };
  return { name, help, JobHelp, true, ShowOptions<Options>, run };
}
}

std::vector<Command> CommandTable()
{
  return {
    Single("generate", "render an object with virtual cameras and write the data set", "",
      MakeGenerateOptions, Generate),
    Single("run", "make one novel view and report everything about it", JobHelp, MakeRunOptions,
      RunView),
    Shared(
      "render", "make many novel views from one hull and crust", MakeRenderOptions, RenderViews),
    Shared(
      "orbit", "make a video of the object from a moving camera", MakeOrbitOptions, RenderOrbit),
    Single("view", "show novel views in a browser, from any camera", JobHelp, MakeViewOptions,
      ServeView),
    Single("mesh", "make a textured mesh of the whole object", JobHelp, MakeMeshOptions, MakeMesh),
    Shared("evaluate", "compare novel views with photographs that no stage uses",
      MakeEvaluateOptions, EvaluateDataset),
    Single("convert", "write a data set in another format, with photographs and masks", FolderHelp,
      MakeConvertOptions, ConvertDataset),
    Single("check",
      "examine a data set: files, masks, cameras, conventions; exit code 3 if there are problems",
      FolderHelp, MakeCheckOptions, RunCheck),
    Single("mask", "write a mask for every photograph, and a contact sheet for inspection",
      FolderHelp, MakeMaskOptions, WriteMasks),
  };
}
}
