// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/CommandSupport.h"

#include "ViewAccess.h"
#include "base/AtomicFile.h"
#include "base/InputFile.h"
#include "core/Error.h"
#include "dataset/PhotographSize.h"
#include "images/ImageFile.h"

#include <algorithm>

namespace novelview
{
namespace fs = std::filesystem;

void PrepareFolder(const fs::path& folder, const std::vector<fs::path>& files)
{
  for (const fs::path& file : files)
  {
    AnnounceOutput(folder / file);
  }
  RequireWritable(folder);
}

DatasetIndex FindInput(const DatasetInput& input)
{
  DatasetIndex index = ReadDatasetIndex(input.Dataset, input.Source);
  LimitSize(index, input.Exclude, input.MaxSize);
  return index;
}

void WarnOf(const DatasetIndex& index, Console& console)
{
  for (const ReadingNote& note : index.Notes)
  {
    console.Warn(note.Text);
  }
}

Dataset ReadInput(const DatasetInput& input, const DatasetIndex& index,
  const std::vector<std::string>& heldOut, Console& console)
{
  DatasetOptions options;
  options.Exclude = input.Exclude;
  options.ForceSilhouettes = input.ForceSilhouettes;
  options.Silhouette = input.Silhouette;
  for (const std::string& name : heldOut)
  {
    if (std::find(options.Exclude.begin(), options.Exclude.end(), name) == options.Exclude.end())
    {
      options.Exclude.push_back(name);
    }
  }
  Dataset dataset;
  console.RunTimed("photographs",
    [&] { dataset = ReadDataset(index, options, console.ProgressOf("photographs")); });
  for (const std::string& warning : dataset.Warnings)
  {
    console.Warn(warning);
  }
  return dataset;
}

SynthesisListener ListenerFor(Console& console)
{
  SynthesisListener listener;
  listener.Progress = [&console](const std::string& stage, double fraction)
  { return console.Progress(stage, fraction); };
  listener.StageDone = [&console](const std::string& stage, double seconds)
  { console.StageDone(stage, seconds); };
  listener.StagesOverlapped = [&console](double seconds) { console.StagesOverlapped(seconds); };
  listener.Warn = [&console](const std::string& text) { console.Warn(text); };
  return listener;
}

vtkSmartPointer<vtkImageData> ReadTruth(
  const Photograph& truth, const SilhouetteOptions& silhouette, const Camera& camera)
{
  const PhotographPixels pixels = ReadPhotograph(truth, false, silhouette);
  const Image<std::uint8_t>& color = pixels.Color;
  if (color.Width != camera.Width || color.Height != camera.Height)
  {
    throw Error(truth.File.string(), "the truth is not of the novel view's size",
      SizeText(color.Width, color.Height), SizeText(camera.Width, camera.Height));
  }
  auto image = NewImage(color.Width, color.Height);
  SetPixels(image, arrays::Color, color.Ref());
  SetPixels(image, arrays::Mask, pixels.Mask.Ref());
  return image;
}
}
