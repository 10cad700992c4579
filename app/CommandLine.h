// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CommandLine_h
#define novelview_CommandLine_h

#include "Console.h"
#include "Generator.h"
#include "Job.h"

#include <filesystem>
#include <functional>

namespace novelview
{
/** What the commands do once their options are known. An empty one is no command. */
struct Commands
{
  std::function<void(const GeneratorOptions&, const std::filesystem::path& out, Console&)> Generate;
  std::function<void(const Job&, Console&)> Run;
  std::function<void(const RenderOptions&, Console&)> Render;
  std::function<void(const OrbitOptions&, Console&)> Orbit;
  std::function<void(const MeshOptions&, Console&)> Mesh;
  std::function<void(const EvaluateOptions&, Console&)> Evaluate;
  std::function<void(const ConvertOptions&, Console&)> Convert;
  std::function<bool(const CheckOptions&, Console&)> Check; ///< whether there are no problems
  std::function<void(const MaskOptions&, Console&)> Mask;

  // ---- of several processes, all of which parse the same words
  int Rank = 0;      ///< only 0 tells the user anything
  int Processes = 1; ///< with more, commands that cannot be shared are an error
  /** The signal that asked for a stop. */
  std::function<int()> StopSignal;
  /** Hears in the other processes why a command failed, which the first tells the user. */
  std::function<void(const std::string& error)> Failed;
};

/** Exit codes of the program. */
struct ExitCode
{
  static constexpr int Ok = 0;
  static constexpr int Failed = 1;    ///< the run failed
  static constexpr int Usage = 2;     ///< bad options or job file
  static constexpr int Problems = 3;  ///< `check` found some
  static constexpr int Stopped = 128; ///< and the signal's number, as shells have it
};

/**
 * The whole program: parses the words after the program's name, runs one command, says each error
 * in one line and returns the exit code.
 */
int RunCommandLine(int argc, const char* const* argv, const Commands& commands);
}

#endif
