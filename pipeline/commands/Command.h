// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Command_h
#define novelview_Command_h

#include "base/Console.h"
#include "options/Options.h"
#include "processes/ProcessGroup.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace novelview
{
/** Exit codes of the program. */
struct ExitCode
{
  static constexpr int Ok = 0;
  static constexpr int Failed = 1;    ///< the run failed
  static constexpr int Usage = 2;     ///< bad options or job file
  static constexpr int Problems = 3;  ///< `check` found some
  static constexpr int Stopped = 128; ///< and the signal's number, as shells have it
};

/** What a command works with. */
struct CommandContext
{
  Console& Out;
  /** Starts the processes of mpirun, once the command is known to be shared between them. */
  std::function<ProcessGroup&(int rankTimeoutSeconds)> StartProcesses;
};

/** A command of the program. Parser, help, man pages, completion and dispatch all read these. */
struct Command
{
  std::string Name;
  std::string Help;
  std::string DatasetHelp; ///< of the word DATASET; empty = the command takes none
  bool Shared = false;     ///< the processes of mpirun share the work
  /** Shows the option table with the defaults of the command; it is valid only during the call. */
  std::function<void(const std::function<void(const OptionTable&)>& show)> ShowOptions;
  /** Parses the options and does the work; returns the exit code. Throws UsageError and Error. */
  std::function<int(
    const std::filesystem::path& dataset, const ParsedArguments& given, CommandContext& context)>
    Run;
};

/** All commands, in the order of the help. */
std::vector<Command> CommandTable();
}

#endif
