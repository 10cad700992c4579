// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CommandLine_h
#define novelview_CommandLine_h

#include "commands/Command.h"

#include <functional>
#include <string>
#include <vector>

namespace novelview
{
/** The process among those of mpirun, all of which parse the same words. */
struct ProcessContext
{
  int Rank = 0;  ///< only 0 prints to the user
  int Count = 1; ///< with more, commands that cannot be shared are an error
  std::function<ProcessGroup&(int rankTimeoutSeconds)> Start;
  /** The signal that requested a stop. */
  std::function<int()> StopSignal;
  /** Called in the other processes with the reason of a failure; the first process prints it. */
  std::function<void(const std::string& error)> Failed;
};

/**
 * The whole program: parses the arguments, runs one command, prints each error
 * in one line and returns the exit code (ExitCode).
 */
int RunCommandLine(int argc, const char* const* argv, const std::vector<Command>& commands,
  const ProcessContext& processes = {});
}

#endif
