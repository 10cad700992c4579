// SPDX-License-Identifier: GPL-3.0-or-later
#include "CommandLine.h"
#include "ConvertCommand.h"
#include "EvaluateCommand.h"
#include "MeshCommand.h"
#include "RunCommand.h"

#include <csignal>

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
}

int main(int argc, char** argv)
{
  std::signal(SIGINT, OnInterrupt);
  Commands commands;
  commands.Generate = Generate;
  commands.Run = RunJob;
  commands.Render = RenderJob;
  commands.Mesh = MakeMesh;
  commands.Evaluate = EvaluateDataset;
  commands.Convert = ConvertDataset;
  return RunCommandLine(argc, argv, commands);
}
