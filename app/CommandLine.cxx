// SPDX-License-Identifier: GPL-3.0-or-later
#include "CommandLine.h"

#include "AtomicFile.h"
#include "InputFile.h"
#include "OptionParser.h"
#include "Parallel.h"
#include "UsageError.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
constexpr const char* PhotographsHelp = "folder of the photographs";

/** What every command has. */
struct CommonFlags
{
  bool Quiet = false;
  bool Verbose = false;
  fs::path Timings; ///< empty = none are written

  void AddTo(CLI::App& command)
  {
    command.add_flag("-q,--quiet", this->Quiet, "warnings and errors only")->group("Program");
    command.add_flag("-v,--verbose", this->Verbose, "tell details")
      ->group("Program")
      ->excludes("--quiet");
    command
      .add_option("--timings", this->Timings,
        "JSON file that gets the seconds of every stage, by how much stages overlapped, the "
        "threads and the peak memory")
      ->group("Program")
      ->type_name("PATH");
  }
  Verbosity Level() const
  {
    return this->Quiet ? Verbosity::Quiet
                       : (this->Verbose ? Verbosity::Verbose : Verbosity::Normal);
  }
};

/** Everything the parser fills. */
struct Parsed
{
  CommonFlags Common;
  std::string Dataset;
  std::string Out;
  int Threads = 0;
  OptionParser Generate;
  OptionParser Run;
  OptionParser Render;
  OptionParser Orbit;
  OptionParser Mesh;
  OptionParser Evaluate;
  OptionParser Convert;
  OptionParser Check;
  OptionParser Mask;
};

CLI::App* AddCommand(
  CLI::App& app, const std::string& name, const std::string& help, Parsed& parsed)
{
  CLI::App* command = app.add_subcommand(name, help);
  parsed.Common.AddTo(*command);
  return command;
}

void AddDataset(CLI::App& command, Parsed& parsed, const std::string& help)
{
  command.add_option("dataset", parsed.Dataset, help)->required()->type_name("DATASET");
}

/** The options of a table, but for those that are given otherwise. */
OptionTable Without(OptionTable table, const std::string& key)
{
  std::erase_if(table, [&key](const Option& option) { return option.Key == key; });
  return table;
}

void AddGenerate(CLI::App& app, Parsed& parsed)
{
  GeneratorOptions defaults;
  CLI::App* generate = AddCommand(
    app, "generate", "photograph an object with virtual cameras and write the data set", parsed);
  generate->add_option("--out", parsed.Out, "folder for the data set")
    ->required()
    ->type_name("PATH");
  generate->add_option("--threads", parsed.Threads, "threads to use; 0 = one per core (default: 0)")
    ->group("Program")
    ->type_name("INT")
    ->check(CLI::Range(0, 1024));
  parsed.Generate.AddTo(*generate, OptionsOf(defaults));
}

void AddConvert(CLI::App& app, Parsed& parsed)
{
  ConvertOptions defaults;
  CLI::App* convert = AddCommand(
    app, "convert", "write a data set in another format, photographs and masks along", parsed);
  AddDataset(*convert, parsed, PhotographsHelp);
  convert->add_option("out", parsed.Out, "folder for the new data set")
    ->required()
    ->type_name("PATH");
  parsed.Convert.AddTo(*convert, OptionsOf(defaults));
}

void AddCheck(CLI::App& app, Parsed& parsed)
{
  CheckOptions defaults;
  CLI::App* check = AddCommand(app, "check",
    "examine a data set: files, masks, cameras, conventions; exit code 3 when something is wrong",
    parsed);
  AddDataset(*check, parsed, PhotographsHelp);
  parsed.Check.AddTo(*check, Without(OptionsOf(defaults), "dataset"));
}

void AddMask(CLI::App& app, Parsed& parsed)
{
  MaskOptions defaults;
  CLI::App* mask = AddCommand(
    app, "mask", "write a mask for every photograph, and a contact sheet to look at", parsed);
  AddDataset(*mask, parsed, PhotographsHelp);
  parsed.Mask.AddTo(*mask, OptionsOf(defaults));
}

/** A command on a data set; its table tells the defaults of the options. */
template <class Options>
void AddOnDataset(CLI::App& app, const std::string& name, const std::string& help, Parsed& parsed,
  OptionParser& parser)
{
  Options defaults;
  defaults.Synthesis = DefaultsOf<Options>(defaults.Synthesis.Preset);
  CLI::App* command = AddCommand(app, name, help, parsed);
  AddDataset(*command, parsed,
    "folder of the photographs, or a JSON job file that holds any of the options");
  parser.AddTo(*command, Without(OptionsOf(defaults), "dataset"));
}

void AddCommands(CLI::App& app, Parsed& parsed, const Commands& commands)
{
  if (commands.Generate)
  {
    AddGenerate(app, parsed);
  }
  if (commands.Run)
  {
    AddOnDataset<Job>(
      app, "run", "make one novel view and report everything about it", parsed, parsed.Run);
  }
  if (commands.Render)
  {
    AddOnDataset<RenderOptions>(
      app, "render", "make many novel views from one hull and crust", parsed, parsed.Render);
  }
  if (commands.Orbit)
  {
    AddOnDataset<OrbitOptions>(
      app, "orbit", "make a film of the object from a moving camera", parsed, parsed.Orbit);
  }
  if (commands.Mesh)
  {
    AddOnDataset<MeshOptions>(
      app, "mesh", "make a textured mesh of the whole object", parsed, parsed.Mesh);
  }
  if (commands.Evaluate)
  {
    AddOnDataset<EvaluateOptions>(app, "evaluate",
      "compare novel views with photographs that no stage saw", parsed, parsed.Evaluate);
  }
  if (commands.Convert)
  {
    AddConvert(app, parsed);
  }
  if (commands.Check)
  {
    AddCheck(app, parsed);
  }
  if (commands.Mask)
  {
    AddMask(app, parsed);
  }
}

/** Runs the command; returns the exit code. */
int Dispatch(const CLI::App& app, const Parsed& parsed, const Commands& commands, Console& console)
{
  const std::string command = app.get_subcommands().front()->get_name();
  if (commands.Processes > 1 && command != "render" && command != "orbit" && command != "evaluate")
  {
    throw UsageError(command, "cannot be shared between processes",
      std::to_string(commands.Processes) + " processes", "1, or render, orbit or evaluate");
  }
  if (command == "generate")
  {
    GeneratorOptions options;
    const OptionTable table = OptionsOf(options);
    for (const auto& [key, words] : parsed.Generate.Given())
    {
      SetFromText(*std::find_if(table.begin(), table.end(),
                    [&key = key](const Option& option) { return option.Key == key; }),
        words);
    }
    LimitThreads(parsed.Threads);
    commands.Generate(options, parsed.Out, console);
  }
  else if (command == "run")
  {
    const Job job = MakeJob(parsed.Dataset, parsed.Run.Given());
    LimitThreads(job.Threads);
    commands.Run(job, console);
  }
  else if (command == "render")
  {
    commands.Render(MakeRenderOptions(parsed.Dataset, parsed.Render.Given()), console);
  }
  else if (command == "orbit")
  {
    commands.Orbit(MakeOrbitOptions(parsed.Dataset, parsed.Orbit.Given()), console);
  }
  else if (command == "mesh")
  {
    const MeshOptions options = MakeMeshOptions(parsed.Dataset, parsed.Mesh.Given());
    LimitThreads(options.Threads);
    commands.Mesh(options, console);
  }
  else if (command == "convert")
  {
    const ConvertOptions options =
      MakeConvertOptions(parsed.Dataset, parsed.Out, parsed.Convert.Given());
    LimitThreads(options.Threads);
    commands.Convert(options, console);
  }
  else if (command == "check")
  {
    const CheckOptions options = MakeCheckOptions(parsed.Dataset, parsed.Check.Given());
    LimitThreads(options.Threads);
    return commands.Check(options, console) ? ExitCode::Ok : ExitCode::Problems;
  }
  else if (command == "mask")
  {
    const MaskOptions options = MakeMaskOptions(parsed.Dataset, parsed.Mask.Given());
    LimitThreads(options.Threads);
    commands.Mask(options, console);
  }
  else
  {
    commands.Evaluate(MakeEvaluateOptions(parsed.Dataset, parsed.Evaluate.Given()), console);
  }
  return ExitCode::Ok;
}

/** " did you mean ..?", when a word is near one of the known ones. */
std::string Suggestion(const std::string& word, const std::vector<std::string>& known)
{
  const std::string nearest = NearestWord(word, known);
  return nearest.empty() ? "" : ", did you mean " + nearest + "?";
}

/** What CLI11 found wrong, in one line; it does not suggest the word that was meant. */
std::string Explanation(
  const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv)
{
  if (app.get_subcommands().empty() && argc > 1 && argv[1][0] != '-')
  {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({}))
    {
      names.push_back(command->get_name());
    }
    return std::string("unknown command ") + argv[1] + Suggestion(argv[1], names);
  }
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError))
  {
    const std::string word = app.remaining(true).front();
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_subcommands().front()->get_options())
    {
      names.push_back(option->get_name());
    }
    return "unknown option " + word + Suggestion(word, names);
  }
  return error.what();
}
}

int RunCommandLine(int argc, const char* const* argv, const Commands& commands)
{
  CLI::App app("Novel views of an object from a dozen calibrated photographs.", "novelview");
  app.set_version_flag("--version", "novelview " NOVELVIEW_VERSION);
  app.require_subcommand(1);
  Parsed parsed;
  AddCommands(app, parsed, commands);
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
    {
      if (commands.Rank == 0)
      {
        app.exit(error); // --help and --version
      }
      return ExitCode::Ok;
    }
    Console(commands.Rank == 0 ? Verbosity::Normal : Verbosity::Silent)
      .Error(Explanation(app, error, argc, argv) + " (--help tells the options)");
    return ExitCode::Usage;
  }
  catch (const std::exception& error)
  {
    Console(commands.Rank == 0 ? Verbosity::Normal : Verbosity::Silent).Error(ErrorText(error));
    return ExitCode::Failed;
  }
  Console console(commands.Rank == 0 ? parsed.Common.Level() : Verbosity::Silent);
  const auto failed = [&](const std::exception& error, int code)
  {
    const std::string text = ErrorText(error);
    console.Error(text);
    if (commands.Failed)
    {
      commands.Failed(text);
    }
    return code;
  };
  try
  {
    if (!parsed.Common.Timings.empty() && commands.Rank == 0)
    {
      AnnounceOutput(parsed.Common.Timings);
    }
    const int code = Dispatch(app, parsed, commands, console);
    if (!parsed.Common.Timings.empty() && commands.Rank == 0)
    {
      WriteTextAtomically(parsed.Common.Timings, console.TimingsText());
    }
    return code;
  }
  catch (const Interrupted&)
  {
    console.Error("interrupted");
    return ExitCode::Stopped + (commands.StopSignal ? commands.StopSignal() : SIGINT);
  }
  catch (const UsageError& error)
  {
    return failed(error, ExitCode::Usage);
  }
  catch (const std::exception& error)
  {
    return failed(error, ExitCode::Failed);
  }
}
}
