// SPDX-License-Identifier: GPL-3.0-or-later
/** The processes that do one run together, started as `mpirun -n N novelview ..`. */
#ifndef novelview_ProcessGroup_h
#define novelview_ProcessGroup_h

#include "synthesis/SceneGeometry.h"

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace novelview
{
/** A message about an item of work for the console. */
struct LogRecord
{
  std::string Text;
  double Seconds = -1; ///< of the stage Text; below 0 = Text is a warning
};

/** What a piece of work results in: the same bits, whichever process made it. */
struct WorkResult
{
  std::vector<double> Numbers;
  std::vector<vtkSmartPointer<vtkImageData>> Images;
  std::vector<LogRecord> Notes;
};

/** How this process was started, by the launcher's environment; nothing is initialised for that. */
struct LaunchPlace
{
  int Rank = 0;
  int Size = 1;
  int SizeHere = 1; ///< processes on this machine
};
LaunchPlace FindLaunchPlace();

/**
 * The processes of a run. All of them go through a command together; the first, rank 0, reads the
 * photographs, writes every file and prints messages. This class is one process alone; the one that
 * StartProcesses() makes may be one of many.
 */
class ProcessGroup
{
public:
  using Make = std::function<WorkResult(std::size_t item)>;
  using Take = std::function<void(std::size_t item, const WorkResult& result)>;

  virtual ~ProcessGroup() = default;

  virtual int Rank() const { return 0; }
  virtual int Size() const { return 1; }

  /** Threads that are this process's share of the machine, while others work as well. */
  virtual int ThreadsHere() const { return 0; }

  /** Gives what the first process has to all of them: the crust, if any, and the views. */
  virtual void Share(SceneGeometry& scene);

  /**
   * Calls `make` once for each item below `count`, in whichever process has nothing else to do,
   * and in the first process `take` for each, in order. Throws what they throw, and in the first
   * process the error of another.
   */
  virtual void ForEach(std::size_t count, const Make& make, const Take& take);

  /** Whether another process has failed, so that this one need not go on. */
  virtual bool OtherFailed() const { return false; }

  /** Reports an error of this process to the first one. Returns false when it does not answer. */
  virtual bool ReportFailure(const std::string& text);

  /** Ends all processes at once. Returns only when this is the only one. */
  virtual void EndAll(int code);
};

/**
 * The processes this one was started with. Without a launcher, one alone, and MPI is not even
 * initialised. Throws Error when there are several, but the program was built without MPI.
 * @param rankTimeoutSeconds the run ends when a process is silent for this long, see MpiHeartbeat.h;
 * 0 = never.
 */
std::unique_ptr<ProcessGroup> StartProcesses(int* argc, char*** argv, double rankTimeoutSeconds);

/**
 * Whether this process has been stopped for so long that the others have ended the run, and
 * reported why. May be called by a signal handler.
 */
bool StoodStillTooLong();
}

#endif
