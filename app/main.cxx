// SPDX-License-Identifier: GPL-3.0-or-later
#include "CommandLine.h"
#include "ProcessSetup.h"
#include "base/InputFile.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <iostream>
#include <memory>
#include <system_error>
#include <thread>
#include <unistd.h>

using namespace novelview;

namespace
{
volatile std::sig_atomic_t StopSignal = SIGINT;

/** The first Ctrl-C, or another signal that ends programs, requests an orderly stop; the second
 * kills. */
extern "C" void OnStopSignal(int number)
{
  if (number == SIGTERM && StoodStillTooLong())
  {
    ::_exit(ExitCode::Stopped + number); // from mpirun, and another process has printed the reason
  }
  StopSignal = number;
  Console::Interrupt();
  for (const int each : { SIGINT, SIGTERM, SIGHUP })
  {
    std::signal(each, SIG_DFL);
  }
}

void HeedSignals()
{
  for (const int each : { SIGINT, SIGTERM, SIGHUP })
  {
    if (each != SIGINT && FindLaunchPlace().Rank > 0)
    {
      continue; // mpirun ends these; the first process prints the reason
    }
    if (std::signal(each, OnStopSignal) == SIG_IGN && each == SIGHUP)
    {
      std::signal(each, SIG_IGN); // started by nohup
    }
  }
  // A file that grows too large for the user's limit is an error of writing.
  std::signal(SIGXFSZ, SIG_IGN);
}

/** Files get the numbers of standard streams that are closed, and messages would go into them. */
void OpenMissingStreams()
{
  for (const int descriptor : { STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO })
  {
    if (::fcntl(descriptor, F_GETFD) < 0)
    {
      ::open("/dev/null", descriptor == STDIN_FILENO ? O_RDONLY : O_WRONLY);
    }
  }
}

/** Whether the whole output was written; a full disk or a closed pipe may prevent it. */
int FlushOutput(int code)
{
  std::cout.flush();
  errno = 0;
  if ((std::fflush(stdout) != 0 || std::ferror(stdout) || !std::cout) && code == ExitCode::Ok)
  {
    std::fprintf(stderr, "novelview: error: standard output: cannot be written%s%s\n",
      errno ? ": " : "", errno ? std::generic_category().message(errno).c_str() : "");
    return ExitCode::Failed;
  }
  return code;
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

  ProcessGroup& Start(int rankTimeoutSeconds)
  {
    this->Processes = StartProcesses(&this->Count, &this->Words, rankTimeoutSeconds);
    return *this->Processes;
  }

  /** The first process prints the error and ends all processes; if it does not, this one does. */
  void ReportFailure(const std::string& error)
  {
    if (this->Processes && this->Processes->ReportFailure(error))
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
      // mpirun ends all processes when one ends; the first process fails as well and prints the
      // reason before.
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
  OpenMissingStreams();
  SetUpProcess();
  HeedSignals();
  const InputProtection protection;
  Launch launch(argc, argv);
  ProcessContext processes;
  processes.Rank = FindLaunchPlace().Rank;
  processes.Count = FindLaunchPlace().Size;
  processes.Start = [&launch](int timeout) -> ProcessGroup& { return launch.Start(timeout); };
  processes.Failed = [&launch](const std::string& error) { launch.ReportFailure(error); };
  processes.StopSignal = [] { return static_cast<int>(StopSignal); };
  return launch.End(FlushOutput(RunCommandLine(argc, argv, CommandTable(), processes)));
}
