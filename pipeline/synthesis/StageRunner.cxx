// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis/StageRunner.h"

#include "Threads.h"
#include "core/Error.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
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

/** Observes one filter during its lifetime. */
class StageObserver
{
public:
  StageObserver(const std::string& stage, vtkAlgorithm* filter, const StageProgress& progress)
    : Stage(stage)
    , Filter(filter)
    , Progress(progress)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(&StageObserver::OnEvent);
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
  static void OnEvent(vtkObject* caller, unsigned long event, void* clientData, void* callData)
  {
    auto* self = static_cast<StageObserver*>(clientData);
    if (event == vtkCommand::ErrorEvent)
    {
      // The executive's own error only states that the filter failed.
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

namespace
{
/** A stage that runs in its own thread. */
class StageBeside
{
public:
  explicit StageBeside(const StageRun& run)
    : Work(std::async(std::launch::async, [this, &run] { this->Run(run); }))
  {
  }
  ~StageBeside() { this->Stopped = true; } // and the future waits

  bool Began() const { return this->Begun; }
  bool EndsWithin(std::chrono::milliseconds time) const
  {
    return this->Work.wait_for(time) == std::future_status::ready;
  }
  void Stop() { this->Stopped = true; }
  /** Its seconds, below 0 when it was up to date; or throws what it threw. */
  double Get()
  {
    this->Work.get();
    return this->Seconds;
  }

private:
  void Run(const StageRun& run)
  {
    RunStage(
      run.Stage, run.Filter,
      [this](const std::string&, double)
      {
        this->Begun = true;
        return !this->Stopped;
      },
      [this](const std::string&, double seconds) { this->Seconds = seconds; });
  }

  std::atomic<bool> Begun = false;
  std::atomic<bool> Stopped = false;
  double Seconds = -1;
  std::future<void> Work; // the last member: it begins at once, and its end is waited for first
};
}

double RunStagesTogether(const StageRun& first, const StageRun& second,
  const StageProgress& progress, const StageDone& done)
{
  if (NumberOfThreads() < 2)
  {
    RunStage(second.Stage, second.Filter, progress, done);
    RunStage(first.Stage, first.Filter, progress, done);
    return 0;
  }
  const auto start = std::chrono::steady_clock::now();
  StageBeside beside(second);
  bool told = false;
  const auto tellSecond = [&](double fraction)
  {
    told = true;
    return !progress || progress(second.Stage, fraction);
  };
  const auto tell = [&](const std::string& stage, double fraction)
  {
    const bool goOn = told || !beside.Began() || tellSecond(0);
    return (!progress || progress(stage, fraction)) && goOn;
  };
  double seconds = -1; // of the first
  RunStage(first.Stage, first.Filter, tell,
    [&seconds](const std::string&, double taken) { seconds = taken; });
  const bool secondWasEarlier = beside.EndsWithin(std::chrono::milliseconds(0));
  while (!beside.EndsWithin(std::chrono::milliseconds(50)))
  {
    if (beside.Began() && !tellSecond(0))
    {
      beside.Stop();
    }
  }
  const double secondsBeside = beside.Get();
  if (!told && beside.Began() && !tellSecond(1))
  {
    throw Interrupted();
  }
  const std::chrono::duration<double> both = std::chrono::steady_clock::now() - start;
  std::pair<std::string, double> ended[2] = { { second.Stage, secondsBeside },
    { first.Stage, seconds } };
  if (!secondWasEarlier)
  {
    std::swap(ended[0], ended[1]);
  }
  for (const auto& [stage, taken] : ended)
  {
    if (done && taken >= 0)
    {
      done(stage, taken);
    }
  }
  return std::max(0.0, std::max(seconds, 0.0) + std::max(secondsBeside, 0.0) - both.count());
}
}
