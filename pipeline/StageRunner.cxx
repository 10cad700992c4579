// SPDX-License-Identifier: GPL-3.0-or-later
#include "StageRunner.h"

#include "Error.h"
#include "Parallel.h"
#include "Threads.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <utility>

namespace novelview
{
namespace
{
/** The part of VTK's error text that the filter wrote: after "class (address): ". */
std::string OwnText(const std::string& text)
{
  const std::size_t address = text.find("): ");
  std::string own = address == std::string::npos ? text : text.substr(address + 3);
  while (!own.empty() && (own.back() == '\n' || own.back() == ' '))
  {
    own.pop_back();
  }
  return own;
}

/** Listens to one filter for as long as it lives. */
class StageObserver
{
public:
  StageObserver(const std::string& stage, vtkAlgorithm* filter, const StageProgress& progress)
    : Stage(stage)
    , Filter(filter)
    , Progress(progress)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(&StageObserver::Hear);
    filter->AddObserver(vtkCommand::ErrorEvent, this->Command);
    filter->AddObserver(vtkCommand::ProgressEvent, this->Command);
    filter->AddObserver(vtkCommand::StartEvent, this->Command);
    filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Command);
  }
  ~StageObserver()
  {
    this->Filter->RemoveObserver(this->Command);
    this->Filter->GetExecutive()->RemoveObserver(this->Command);
  }

  std::string FirstError;
  bool StopAsked = false;
  bool Executed = false; ///< it was not up to date already

private:
  static void Hear(vtkObject* caller, unsigned long event, void* clientData, void* callData)
  {
    auto* self = static_cast<StageObserver*>(clientData);
    if (event == vtkCommand::ErrorEvent)
    {
      // The executive's own error only says that the filter failed.
      if (self->FirstError.empty() || caller == self->Filter)
      {
        self->FirstError = OwnText(static_cast<const char*>(callData));
      }
    }
    else if (event == vtkCommand::StartEvent)
    {
      self->Executed = true;
    }
    else if (self->Progress && !self->Progress(self->Stage, *static_cast<const double*>(callData)))
    {
      self->StopAsked = true;
      self->Filter->SetAbortExecute(1);
    }
  }

  const std::string& Stage;
  vtkAlgorithm* Filter;
  const StageProgress& Progress;
  vtkNew<vtkCallbackCommand> Command;
};
}

void RunStage(const std::string& stage, vtkAlgorithm* filter, const StageProgress& progress,
  const StageDone& done)
{
  StageObserver observer(stage, filter, progress);
  const auto start = std::chrono::steady_clock::now();
  filter->SetAbortExecute(0);
  filter->Update();
  if (observer.StopAsked || !observer.FirstError.empty())
  {
    filter->Modified(); // or VTK takes the empty outputs for up to date
  }
  if (observer.StopAsked || (!observer.FirstError.empty() && StopRequested()))
  {
    throw Interrupted();
  }
  if (!observer.FirstError.empty())
  {
    // Kernels say where as well, and often that is the stage itself.
    const std::string where = stage + ": ";
    throw Error(stage,
      observer.FirstError.starts_with(where) ? observer.FirstError.substr(where.size())
                                             : observer.FirstError);
  }
  if (done && observer.Executed)
  {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    done(stage, taken.count());
  }
}

double RunStagesTogether(const StageRun& first, const StageRun& second,
  const StageProgress& progress, const StageDone& done)
{
  std::atomic<bool> stopped = false;
  std::atomic<bool> secondBegan = false;
  bool secondTold = false;
  // The listener hears everything in this thread; of the second one, that it began and ended.
  const auto tell = [&](const std::string& stage, double fraction)
  { stopped = stopped || (progress && !progress(stage, fraction)); };
  const StageProgress progressOf[2] = {
    [&](const std::string& stage, double fraction)
    {
      if (secondBegan && !std::exchange(secondTold, true))
      {
        tell(second.Stage, 0);
      }
      tell(stage, fraction);
      return !stopped;
    },
    [&](const std::string&, double)
    {
      secondBegan = true;
      return !stopped;
    },
  };
  const StageRun* const runs[2] = { &first, &second };
  double seconds[2] = { -1, -1 }; // of those that were not up to date already
  const auto start = std::chrono::steady_clock::now();
  ParallelForEach(2,
    [&](std::size_t i)
    {
      RunStage(runs[i]->Stage, runs[i]->Filter, progressOf[i],
        [&seconds, i](const std::string&, double taken) { seconds[i] = taken; });
    });
  const std::chrono::duration<double> both = std::chrono::steady_clock::now() - start;
  if (secondBegan)
  {
    tell(second.Stage, 1);
  }
  if (stopped)
  {
    throw Interrupted();
  }
  for (const int i : { 1, 0 })
  {
    if (done && seconds[i] >= 0)
    {
      done(runs[i]->Stage, seconds[i]);
    }
  }
  return std::max(0.0, std::max(seconds[0], 0.0) + std::max(seconds[1], 0.0) - both.count());
}
}
