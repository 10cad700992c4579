// SPDX-License-Identifier: GPL-3.0-or-later
#include "CommandLine.h"

#include "AtomicFile.h"
#include "OptionParser.h"
#include "Parallel.h"
#include "UsageError.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
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
        "JSON file that gets the seconds of every stage, the threads and the peak memory")
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
  OptionParser Mesh;
  OptionParser Evaluate;
  OptionParser Convert;
};

CLI::App* AddCommand(
  CLI::App& app, const std::string& name, const std::string& help, Parsed& parsed)
{
  CLI::App* command = app.add_subcommand(name, help);
  parsed.Common.AddTo(*command);
  return command;
}

void AddDataset(CLI::App& command, Parsed& parsed)
{
  command
    .add_option("dataset", parsed.Dataset,
      "folder of the photographs, or a JSON job file that holds any of the options")
    ->required()
    ->type_name("DATASET");
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
  convert->add_option("dataset", parsed.Dataset, "folder of the photographs")
    ->required()
    ->type_name("DATASET");
  convert->add_option("out", parsed.Out, "folder for the new data set")
    ->required()
    ->type_name("PATH");
  parsed.Convert.AddTo(*convert, OptionsOf(defaults));
}

/** A command on a data set; its table tells the defaults of the options. */
template <class Options>
void AddOnDataset(CLI::App& command, Parsed& parsed, OptionParser& parser)
{
  Options defaults;
  defaults.Synthesis = PresetOptions(defaults.Synthesis.Preset);
  AddDataset(command, parsed);
  parser.AddTo(command, Without(OptionsOf(defaults), "dataset"));
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
      *AddCommand(app, "run", "make one novel view and report everything about it", parsed), parsed,
      parsed.Run);
  }
  if (commands.Render)
  {
    AddOnDataset<RenderOptions>(
      *AddCommand(app, "render", "make many novel views from one hull and crust", parsed), parsed,
      parsed.Render);
  }
  if (commands.Mesh)
  {
    AddOnDataset<MeshOptions>(
      *AddCommand(app, "mesh", "make a textured mesh of the whole object", parsed), parsed,
      parsed.Mesh);
  }
  if (commands.Evaluate)
  {
    AddOnDataset<EvaluateOptions>(
      *AddCommand(
        app, "evaluate", "compare novel views with photographs that no stage saw", parsed),
      parsed, parsed.Evaluate);
  }
  if (commands.Convert)
  {
    AddConvert(app, parsed);
  }
}

void Dispatch(const CLI::App& app, const Parsed& parsed, const Commands& commands, Console& console)
{
  const std::string command = app.get_subcommands().front()->get_name();
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
    const RenderOptions options = MakeRenderOptions(parsed.Dataset, parsed.Render.Given());
    LimitThreads(options.Threads);
    commands.Render(options, console);
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
  else
  {
    const EvaluateOptions options = MakeEvaluateOptions(parsed.Dataset, parsed.Evaluate.Given());
    LimitThreads(options.Threads);
    commands.Evaluate(options, console);
  }
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
      app.exit(error); // --help and --version
      return ExitCode::Ok;
    }
    Console(Verbosity::Normal)
      .Error(Explanation(app, error, argc, argv) + " (--help tells the options)");
    return ExitCode::Usage;
  }
  Console console(parsed.Common.Level());
  try
  {
    Dispatch(app, parsed, commands, console);
    if (!parsed.Common.Timings.empty())
    {
      WriteTextAtomically(parsed.Common.Timings, console.TimingsText());
    }
    return ExitCode::Ok;
  }
  catch (const Interrupted&)
  {
    console.Error("interrupted");
    return ExitCode::Interrupted;
  }
  catch (const UsageError& error)
  {
    console.Error(error.what());
    return ExitCode::Usage;
  }
  catch (const std::exception& error)
  {
    console.Error(error.what());
    return ExitCode::Failed;
  }
}
}
