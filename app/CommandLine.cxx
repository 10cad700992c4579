// SPDX-License-Identifier: GPL-3.0-or-later
#include "CommandLine.h"

#include "OptionParser.h"
#include "base/AtomicFile.h"
#include "base/InputFile.h"
#include "base/NumberText.h"
#include "base/UsageError.h"
#include "options/NearestWord.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>

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
    command.add_flag("-v,--verbose", this->Verbose, "print details")
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

/** The options of a table, except one that is given in another way. */
OptionTable Without(OptionTable table, const std::string& key)
{
  std::erase_if(table, [&key](const Option& option) { return option.Key == key; });
  return table;
}

/** Everything the parser fills. */
struct Parsed
{
  CommonFlags Common;
  std::string Dataset;
  std::vector<OptionParser> Options; ///< one per command
};

void AddCommands(CLI::App& app, Parsed& parsed, const std::vector<Command>& commands)
{
  parsed.Options.resize(commands.size());
  for (std::size_t i = 0; i < commands.size(); ++i)
  {
    CLI::App* added = app.add_subcommand(commands[i].Name, commands[i].Help);
    parsed.Common.AddTo(*added);
    if (!commands[i].DatasetHelp.empty())
    {
      added->add_option("dataset", parsed.Dataset, commands[i].DatasetHelp)
        ->required()
        ->type_name("DATASET");
    }
    commands[i].ShowOptions([&](const OptionTable& table)
      { parsed.Options[i].AddTo(*added, Without(table, "dataset")); });
  }
}

/** The commands that the processes of mpirun can share, "render, orbit or evaluate". */
std::string SharedNames(const std::vector<Command>& commands)
{
  std::vector<std::string> names;
  for (const Command& command : commands)
  {
    if (command.Shared)
    {
      names.push_back(command.Name);
    }
  }
  if (names.size() < 2)
  {
    return Joined(names);
  }
  const std::string last = names.back();
  names.pop_back();
  return Joined(names) + " or " + last;
}

/** Runs the command; returns the exit code. */
int Dispatch(const CLI::App& app, const Parsed& parsed, const std::vector<Command>& commands,
  const ProcessContext& processes, Console& console)
{
  const std::string name = app.get_subcommands().front()->get_name();
  const auto command = std::find_if(
    commands.begin(), commands.end(), [&name](const Command& each) { return each.Name == name; });
  if (processes.Count > 1 && !command->Shared)
  {
    throw UsageError(name, "cannot be shared between processes",
      std::to_string(processes.Count) + " processes", "1, or " + SharedNames(commands));
  }
  CommandContext context{ console, processes.Start };
  const OptionParser& options =
    parsed.Options[static_cast<std::size_t>(command - commands.begin())];
  return command->Run(parsed.Dataset, options.Given(), context);
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
      if (!option->get_group().empty()) // which former names have
      {
        names.push_back(option->get_name());
      }
    }
    return "unknown option " + word + Suggestion(word, names);
  }
  return error.what();
}
}

int RunCommandLine(int argc, const char* const* argv, const std::vector<Command>& commands,
  const ProcessContext& processes)
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
      if (processes.Rank == 0)
      {
        app.exit(error); // --help and --version
      }
      return ExitCode::Ok;
    }
    Console(processes.Rank == 0 ? Verbosity::Normal : Verbosity::Silent)
      .Error(Explanation(app, error, argc, argv) + " (--help lists the options)");
    return ExitCode::Usage;
  }
  catch (const std::exception& error)
  {
    Console(processes.Rank == 0 ? Verbosity::Normal : Verbosity::Silent).Error(ErrorText(error));
    return ExitCode::Failed;
  }
  Console console(processes.Rank == 0 ? parsed.Common.Level() : Verbosity::Silent);
  const auto failed = [&](const std::exception& error, int code)
  {
    const std::string text = ErrorText(error);
    console.Error(text);
    if (processes.Failed)
    {
      processes.Failed(text);
    }
    return code;
  };
  try
  {
    if (!parsed.Common.Timings.empty() && processes.Rank == 0)
    {
      AnnounceOutput(parsed.Common.Timings);
    }
    const int code = Dispatch(app, parsed, commands, processes, console);
    if (!parsed.Common.Timings.empty() && processes.Rank == 0)
    {
      WriteTextAtomically(parsed.Common.Timings, console.TimingsText());
    }
    return code;
  }
  catch (const Interrupted&)
  {
    console.Error("interrupted");
    return ExitCode::Stopped + (processes.StopSignal ? processes.StopSignal() : SIGINT);
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
