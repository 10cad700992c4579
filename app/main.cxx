// SPDX-License-Identifier: GPL-3.0-or-later
#include "CheckCommand.h"
#include "CommandLine.h"
#include "ConvertCommand.h"
#include "EvaluateCommand.h"
#include "MaskCommand.h"
#include "MeshCommand.h"
#include "OrbitCommand.h"
#include "RunCommand.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <thread>

using namespace novelview;

namespace
{
/** The first Ctrl-C asks for an orderly stop, the second one kills. */
extern "C" void OnInterrupt(int)
{
  Console::Interrupt();
  std::signal(SIGINT, SIG_DFL);
}

void Generate(const GeneratorOptions& options, const std::filesystem::path& out, Console& console)
{
  GenerateDataset(options, out,
    [&console](const std::string& what, double fraction)
    { return console.Progress(what, fraction); });
  console.Info("data set written to " + out.string());
  console.Summary();
}

/** The processes of mpirun; they are not started before a command that is shared. */
class Launch
{
public:
  Launch(int& argc, char**& argv)
    : Count(argc)
    , Words(argv)
  {
  }

  template <class Command>
  auto Shared(Command command)
  {
    return [this, command](const auto& options, Console& console)
    {
      this->Processes = StartProcesses(&this->Count, &this->Words);
      command(options, console, *this->Processes);
    };
  }

  /** The first process says what went wrong here, and ends all; if it does not, this one does. */
  void TellFailure(const std::string& error)
  {
    if (this->Processes && this->Processes->TellFailure(error))
    {
      std::this_thread::sleep_for(std::chrono::seconds(10));
      std::fprintf(stderr, "novelview: error: %s\n", error.c_str());
    }
  }

  /** A process that fails ends the others, which would wait for it for ever. */
  int End(int code)
  {
    if (code != ExitCode::Ok && this->Processes)
    {
      this->Processes->EndAll(code);
    }
    else if (code != ExitCode::Ok && FindLaunchPlace().Rank > 0)
    {
      // mpirun ends all when one does; the first process, which fails alike, says why before.
      std::this_thread::sleep_for(std::chrono::seconds(2));
    }
    return code;
  }

private:
  int& Count;
  char**& Words;
  std::unique_ptr<ProcessGroup> Processes;
};
}

int main(int argc, char** argv)
{
  std::signal(SIGINT, OnInterrupt);
  Launch launch(argc, argv);
  Commands commands;
  commands.Rank = FindLaunchPlace().Rank;
  commands.Processes = FindLaunchPlace().Size;
  commands.Failed = [&launch](const std::string& error) { launch.TellFailure(error); };
  commands.Generate = Generate;
  commands.Run = RunJob;
  commands.Render = launch.Shared(RenderJob);
  commands.Orbit = launch.Shared(FilmOrbit);
  commands.Mesh = MakeMesh;
  commands.Evaluate = launch.Shared(EvaluateDataset);
  commands.Convert = ConvertDataset;
  commands.Check = RunCheck;
  commands.Mask = WriteMasks;
  return launch.End(RunCommandLine(argc, argv, commands));
}
