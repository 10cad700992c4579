// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_WorkDistributor_h
#define novelview_WorkDistributor_h

#include "base/Console.h"
#include "processes/ProcessGroup.h"
#include "synthesis/Synthesis.h"

#include <memory>

namespace novelview
{
/**
 * A command's work on a data set, by one process or several: what does not depend on the novel
 * camera is made in the first process, with all its threads, and handed to the others; views are
 * shared out, each process with its share of the threads. The console receives the same messages in
 * the same order as from one process.
 */
class WorkDistributor
{
public:
  /** `threads` of this process; 0 = its share of the machine. */
  WorkDistributor(Console& console, ProcessGroup& processes, int threads);

  /** Whether this process reads the photographs, writes the files and prints messages. */
  bool Writes() const { return this->Processes.Rank() == 0; }

  /** Reports to the console, or records messages for the first process. */
  SynthesisListener Listener();

  /**
   * A synthesis whose view-independent stages have run, if there are others to hand them to.
   * `views` matter in the first process only.
   */
  std::unique_ptr<Synthesis> Prepare(vtkMultiBlockDataSet* views, const SynthesisOptions& options);

  /** Gives the first process's views to all. */
  vtkSmartPointer<vtkMultiBlockDataSet> Share(vtkMultiBlockDataSet* views);

  /** ProcessGroup::ForEach, and Interrupted when the console requests a stop. */
  void ForEach(std::size_t count, const ProcessGroup::Make& make, const ProcessGroup::Take& take);

private:
  bool Together() const { return this->Processes.Size() > 1; }

  Console& Con;
  ProcessGroup& Processes;
  int Threads;
  std::vector<LogRecord> Notes; ///< of the item in the making
  bool Noting = false;
};

/** An image with its arrays Color and Mask only; pixels are shared. */
vtkSmartPointer<vtkImageData> PictureOnly(vtkImageData* image);
}

#endif
