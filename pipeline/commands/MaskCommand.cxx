// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/MaskCommand.h"

#include "base/InputFile.h"
#include "base/Parallel.h"
#include "base/UsageError.h"
#include "cameras/MaskFiles.h"
#include "cameras/PhotographFiles.h"
#include "commands/CommandSupport.h"
#include "core/Error.h"
#include "dataset/Dataset.h"
#include "formats/DatasetFormats.h"
#include "images/ImageFile.h"
#include "masks/GrabCutMask.h"
#include "masks/MaskSheet.h"

#include <algorithm>
#include <set>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/** A photograph and where its mask goes. */
struct MaskTask
{
  std::string Name;
  fs::path Photo;
  fs::path Target;
  ColorReading Reading;
  Image<std::uint8_t> Mask;
  MaskThumbnail Thumbnail;
};

/** The photographs of the calibration or, where there is none, all that lie in the folder. */
std::vector<Photograph> PhotographsOf(const MaskOptions& options, Console& console)
{
  std::error_code failure;
  const bool calibrated = !options.Source.Calibration.empty() || options.Source.Format != "auto" ||
    !fs::is_directory(options.Dataset, failure) || !CalibrationsIn(options.Dataset).empty();
  DatasetIndex index;
  if (calibrated)
  {
    index = ReadDatasetIndex(options.Dataset, options.Source);
    WarnOf(index, console);
    return WithoutExcluded(index, options.Exclude);
  }
  MaskFiles masks(options.Dataset);
  for (const fs::path& folder : { options.Dataset, options.Dataset / "images" })
  {
    for (const std::string& name : PhotographsIn(folder))
    {
      Photograph photograph;
      photograph.Name = name;
      photograph.File = folder / name;
      photograph.Mask = masks.Of(name);
      index.Cameras.push_back(photograph);
    }
    if (!index.Cameras.empty())
    {
      index.Calibration = folder;
      return WithoutExcluded(index, options.Exclude);
    }
  }
  throw Error(options.Dataset.string(), "contains neither a calibration nor a photograph");
}

/** The name of a photograph's mask in mask/, one that MaskFileOf() looks for. */
std::string MaskName(const std::string& name)
{
  return fs::path(name).extension() == ".png" ? name : name + ".png";
}

/** Where each mask goes; throws UsageError when it is taken. */
std::vector<MaskTask> PlanMasks(const MaskOptions& options, Console& console)
{
  const fs::path out = options.InPlace ? options.Dataset : options.Out;
  std::vector<MaskTask> tasks;
  std::set<fs::path> targets;
  for (const Photograph& photograph : PhotographsOf(options, console))
  {
    MaskTask task{ NameOfFile(photograph.Name), photograph.File, {}, photograph.Reading, {}, {} };
    task.Target = out / "mask" / MaskName(task.Name);
    if (options.InPlace && !photograph.Mask.empty())
    {
      // Readers would go on taking this one, wherever another lies.
      task.Target = photograph.Mask;
      if (task.Target.extension() != ".png")
      {
        throw UsageError(task.Target.string(),
          "this mask is not a PNG file and would still be the one that is read; remove it first");
      }
    }
    std::error_code failure;
    if (!options.Overwrite && fs::exists(task.Target, failure))
    {
      throw UsageError(task.Target.string(), "there is a mask already; --overwrite replaces it");
    }
    if (!targets.insert(task.Target.lexically_normal()).second)
    {
      throw Error(
        "view " + photograph.Name, "two photographs would have the mask " + task.Target.string());
    }
    tasks.push_back(task);
  }
  return tasks;
}

bool IsPhotograph(const fs::path& file, const std::vector<MaskTask>& tasks)
{
  std::error_code failure;
  return std::any_of(tasks.begin(), tasks.end(),
    [&](const MaskTask& task) { return fs::equivalent(task.Photo, file, failure); });
}

/** Announces the masks and the contact sheet; masks that are there may be replaced if so wished. */
void AnnounceMasks(
  const std::vector<MaskTask>& tasks, const fs::path& sheet, const MaskOptions& options)
{
  for (const MaskTask& task : tasks)
  {
    ProtectInput(task.Photo);
    if (options.InPlace && options.Overwrite && !IsPhotograph(task.Target, tasks))
    {
      AllowReplacing(task.Target);
    }
  }
  for (const MaskTask& task : tasks)
  {
    AnnounceOutput(task.Target);
  }
  PrepareFolder(sheet.parent_path(), { sheet.filename() });
}

Image<std::uint8_t> AlphaMask(const fs::path& photograph, int orientation)
{
  Image<std::uint8_t> mask = ReadAlphaFile(photograph, orientation);
  if (mask.Values.empty())
  {
    throw Error(photograph.string(), "has no alpha channel, or an opaque one");
  }
  return mask;
}

Image<std::uint8_t> ByGrabCut(const Image<std::uint8_t>& color, const MaskOptions& options)
{
  GrabCutOptions grabCut;
  grabCut.Rounds = options.GrabCutRounds;
  grabCut.SmallHole = options.Silhouette.SmallHole;
  grabCut.Box = CentralBox(color.Width, color.Height, options.BoxMargin);
  if (!options.Box.empty())
  {
    std::copy(options.Box.begin(), options.Box.end(), grabCut.Box.begin());
  }
  return GrabCutSilhouette(color.Ref(), grabCut);
}

/** How the object is distinguished from the background by the methods that compare colours. */
SilhouetteOptions SilhouetteOptionsOf(const MaskOptions& options)
{
  SilhouetteOptions silhouette = options.Silhouette;
  if (options.Method == "dark")
  {
    silhouette.Background = SilhouetteOptions::Backdrop::Dark;
  }
  if (options.Method == "chroma")
  {
    silhouette.Background = SilhouetteOptions::Backdrop::Chroma;
    if (options.Key.size() == 3)
    {
      silhouette.Key = { options.Key[0], options.Key[1], options.Key[2] };
    }
  }
  return silhouette;
}

void MakeMask(MaskTask& task, const MaskOptions& options)
{
  task.Mask = MaskOf(task.Photo, options, task.Reading);
  const Image<std::uint8_t> color = ReadColorFile(task.Photo, task.Reading);
  task.Thumbnail = MakeMaskThumbnail(task.Name, color.Ref(), task.Mask.Ref());
}
}

Image<std::uint8_t> MaskOf(
  const fs::path& photograph, const MaskOptions& options, const ColorReading& reading)
{
  if (options.Method == "alpha")
  {
    return AlphaMask(photograph, reading.Orientation);
  }
  if (options.Method == "auto")
  {
    Image<std::uint8_t> alpha = ReadAlphaFile(photograph, reading.Orientation);
    if (!alpha.Values.empty())
    {
      return alpha;
    }
  }
  const Image<std::uint8_t> color = ReadColorFile(photograph, reading);
  try
  {
    Image<std::uint8_t> mask = options.Method == "grabcut"
      ? ByGrabCut(color, options)
      : ExtractSilhouette(color.Ref(), SilhouetteOptionsOf(options));
    CheckCoverage(MeasureCoverage(mask.Ref()), "mask");
    return mask;
  }
  catch (const Error& error)
  {
    throw Error(photograph.string(), error.what());
  }
}

void WriteMasks(const MaskOptions& options, Console& console)
{
  std::vector<MaskTask> tasks = PlanMasks(options, console);
  const fs::path sheet =
    (options.InPlace ? options.Dataset / "mask" : options.Out) / "contact-sheet.png";
  AnnounceMasks(tasks, sheet, options);
  console.Progress("masks", 0);
  ParallelForEach(
    tasks.size(), [&](std::size_t i) { MakeMask(tasks[i], options); }, console.ProgressOf("masks"));
  std::vector<MaskThumbnail> thumbnails;
  for (const MaskTask& task : tasks)
  {
    WriteImageFile(task.Target, task.Mask.Ref());
    for (const std::string& warning :
      CheckCoverage(MeasureCoverage(task.Mask.Ref()), "view " + task.Name))
    {
      console.Warn(warning);
    }
    thumbnails.push_back(task.Thumbnail);
  }
  WriteImageFile(sheet, MaskContactSheet(thumbnails).Ref());
  console.Info(std::to_string(tasks.size()) + " masks written to " +
    (options.InPlace ? options.Dataset / "mask" : options.Out / "mask").string() + "; look at " +
    sheet.string());
}
}
