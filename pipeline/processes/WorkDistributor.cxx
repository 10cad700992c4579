// SPDX-License-Identifier: GPL-3.0-or-later
#include "processes/WorkDistributor.h"

#include "ViewAccess.h"
#include "base/Parallel.h"
#include "core/Error.h"

#include <vtkPointData.h>

namespace novelview
{
WorkDistributor::WorkDistributor(Console& console, ProcessGroup& processes, int threads)
  : Con(console)
  , Processes(processes)
  , Threads(threads > 0 ? threads : processes.ThreadsHere())
{
  // Until there are views to share out, the first process is alone at work.
  LimitThreads(threads);
}

SynthesisListener WorkDistributor::Listener()
{
  SynthesisListener listener;
  listener.Progress = [this](const std::string& stage, double fraction)
  { return this->Con.Progress(stage, fraction) && !this->Processes.OtherFailed(); };
  listener.StageDone = [this](const std::string& stage, double seconds)
  {
    if (this->Noting)
    {
      this->Notes.push_back({ stage, seconds });
    }
    else
    {
      this->Con.StageDone(stage, seconds);
    }
  };
  listener.StagesOverlapped = [this](double seconds)
  {
    if (!this->Noting) // stages of several processes overlap anyway
    {
      this->Con.StagesOverlapped(seconds);
    }
  };
  listener.Warn = [this](const std::string& text)
  {
    if (this->Noting)
    {
      this->Notes.push_back({ text });
    }
    else
    {
      this->Con.Warn(text);
    }
  };
  return listener;
}

std::unique_ptr<Synthesis> WorkDistributor::Prepare(
  vtkMultiBlockDataSet* views, const SynthesisOptions& options)
{
  if (!this->Together())
  {
    return std::make_unique<Synthesis>(views, options, this->Listener());
  }
  SceneGeometry results;
  std::unique_ptr<Synthesis> synthesis;
  if (this->Writes())
  {
    synthesis = std::make_unique<Synthesis>(views, options, this->Listener());
    results = synthesis->Prepared();
  }
  this->Processes.Share(results);
  return synthesis ? std::move(synthesis)
                   : std::make_unique<Synthesis>(results, options, this->Listener());
}

vtkSmartPointer<vtkMultiBlockDataSet> WorkDistributor::Share(vtkMultiBlockDataSet* views)
{
  SceneGeometry results;
  results.Views = views;
  this->Processes.Share(results);
  return results.Views;
}

void WorkDistributor::ForEach(
  std::size_t count, const ProcessGroup::Make& make, const ProcessGroup::Take& take)
{
  if (this->Together())
  {
    LimitThreads(this->Threads);
    this->Noting = true;
  }
  this->Processes.ForEach(
    count,
    [&](std::size_t item)
    {
      if (Console::Interrupted())
      {
        throw Interrupted();
      }
      WorkResult result = make(item);
      result.Notes = std::move(this->Notes);
      this->Notes.clear();
      return result;
    },
    [&](std::size_t item, const WorkResult& result)
    {
      for (const LogRecord& note : result.Notes)
      {
        note.Seconds < 0 ? this->Con.Warn(note.Text) : this->Con.StageDone(note.Text, note.Seconds);
      }
      take(item, result);
    });
  this->Noting = false;
}

vtkSmartPointer<vtkImageData> PictureOnly(vtkImageData* image)
{
  auto picture = vtkSmartPointer<vtkImageData>::New();
  picture->CopyStructure(image);
  for (const char* name : { arrays::Color, arrays::Mask })
  {
    picture->GetPointData()->AddArray(image->GetPointData()->GetArray(name));
  }
  return picture;
}
}
