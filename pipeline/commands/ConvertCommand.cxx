// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/ConvertCommand.h"

#include "base/AtomicFile.h"
#include "base/InputFile.h"
#include "base/NumberText.h"
#include "base/Parallel.h"
#include "base/UsageError.h"
#include "commands/CommandSupport.h"
#include "commands/ConvertCameras.h"
#include "dataset/Dataset.h"
#include "dataset/PhotographSize.h"
#include "formats/DatasetFormats.h"
#include "images/ImageFile.h"

#include <algorithm>
#include <set>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/** Whether a copy would be the file itself, which then stays as it is. */
bool IsSame(const fs::path& from, const fs::path& to)
{
  std::error_code failure;
  return fs::equivalent(from, to, failure);
}

void CopyFile(const fs::path& from, const fs::path& to)
{
  if (!IsSame(from, to))
  {
    WriteTextAtomically(to, ReadInputFile(from));
  }
}

/** A photograph and what it becomes. */
struct Conversion
{
  Photograph From;
  Photograph To;          ///< name and camera as written; Mask is set by Transfer()
  bool Undistort = false; ///< or turned: its pixels are written anew
};

/** What is to be done, with every name checked and every size known. */
std::vector<Conversion> Plan(const std::vector<Photograph>& photographs, bool undistort)
{
  std::vector<Conversion> plan;
  std::set<std::string> names;
  for (const Photograph& photograph : photographs)
  {
    // Readers of the new data set need not ask about an orientation that is applied.
    Conversion each{ photograph, photograph,
      (undistort && !photograph.Distortion.IsPinhole()) || photograph.Reading.Orientation != 1 };
    Photograph& to = each.To;
    to.Name = NameOfFile(photograph.Name);
    if (each.Undistort)
    {
      to.Name = fs::path(to.Name).replace_extension(".png").string();
      to.Distortion = Lens();
    }
    if (to.Name.empty() || !names.insert(to.Name).second)
    {
      throw Error(
        "view " + photograph.Name, "two photographs would be written as '" + to.Name + "'");
    }
    if (to.Cam.Width == 0)
    {
      const Camera sized = SizedCamera(photograph);
      to.Cam.Width = sized.Width;
      to.Cam.Height = sized.Height;
    }
    to.Mask.clear();
    plan.push_back(each);
  }
  return plan;
}

std::vector<Photograph> Written(const std::vector<Conversion>& plan)
{
  std::vector<Photograph> written;
  for (const Conversion& each : plan)
  {
    written.push_back(each.To);
  }
  return written;
}

/** Throws when the folder is no place to write into. */
void CheckFolder(const fs::path& from, const fs::path& out, const std::vector<FileContent>& files)
{
  std::error_code failure;
  if (!fs::exists(out, failure))
  {
    return;
  }
  if (fs::equivalent(from, out, failure))
  {
    throw UsageError(out.string(), "is the folder to read; the new data set needs its own");
  }
  for (const FoundCalibration& other : CalibrationsIn(out))
  {
    if (std::none_of(files.begin(), files.end(),
          [&](const FileContent& file) { return out / file.Path == other.File; }))
    {
      throw UsageError(out.string(),
        "already contains another data set: " + other.File.lexically_relative(out).string());
    }
  }
}

/** The pixels as a pinhole would have taken them. */
Image<std::uint8_t> Straight(const Image<std::uint8_t>& pixels, const Photograph& from)
{
  return from.Distortion.IsPinhole() ? pixels
                                     : Undistorted(pixels.Ref(), from.Distortion, from.Cam.K);
}

/** The mask as it is to be written; empty when the photograph has none. */
Image<std::uint8_t> MaskPixels(const Conversion& each)
{
  Image<std::uint8_t> mask = ReadGivenMask(each.From);
  if (mask.Values.empty())
  {
    return mask;
  }
  if (mask.Width != each.To.Cam.Width || mask.Height != each.To.Cam.Height)
  {
    throw Error(each.From.Mask.string(), "mask has another size than its photograph",
      SizeText(mask.Width, mask.Height), SizeText(each.To.Cam.Width, each.To.Cam.Height));
  }
  return each.Undistort ? Straight(mask, each.From) : mask;
}

/** Whether the mask's file is copied; else its pixels are written. */
bool CopiesMask(const Conversion& each)
{
  return !each.Undistort && !each.From.InvertMask && each.From.Mask.extension() == ".png";
}

/** Announces photographs, masks and calibration; files that stay as they are need no announcement. */
void AnnounceFiles(const std::vector<Conversion>& plan, const DatasetFormat& format,
  const std::vector<FileContent>& calibration, const fs::path& out)
{
  for (const Conversion& each : plan)
  {
    const fs::path photo = out / format.PhotoFolder / each.To.Name;
    if (each.Undistort || !IsSame(each.From.File, photo))
    {
      AnnounceOutput(photo);
    }
    const fs::path mask = out / format.MaskFolder / format.MaskName(each.To.Name);
    if (!CopiesMask(each) || !IsSame(each.From.Mask, mask))
    {
      AnnounceOutput(mask);
    }
  }
  std::vector<fs::path> files;
  for (const FileContent& file : calibration)
  {
    files.push_back(file.Path);
  }
  PrepareFolder(out, files);
}

/** Writes photograph and mask. */
void Transfer(Conversion& each, const DatasetFormat& format, const fs::path& out)
{
  const Photograph& from = each.From;
  const fs::path photo = out / format.PhotoFolder / each.To.Name;
  if (each.Undistort)
  {
    const Image<std::uint8_t> color = ReadColorFile(from.File, from.Reading);
    WriteImageFile(photo, Straight(color, from).Ref());
  }
  else
  {
    const PictureSize size = ReadPictureSize(from.File);
    if (size.Width != each.To.Cam.Width || size.Height != each.To.Cam.Height)
    {
      throw Error(from.File.string(), "photograph has another size than its calibration",
        SizeText(size.Width, size.Height), SizeText(each.To.Cam.Width, each.To.Cam.Height));
    }
    CopyFile(from.File, photo);
  }
  const Image<std::uint8_t> mask = MaskPixels(each);
  if (mask.Values.empty())
  {
    return;
  }
  each.To.Mask = fs::path(format.MaskFolder) / format.MaskName(each.To.Name);
  if (CopiesMask(each))
  {
    CopyFile(from.Mask, out / each.To.Mask);
  }
  else
  {
    WriteImageFile(out / each.To.Mask, mask.Ref());
  }
}

void Report(const std::vector<Conversion>& plan, const fs::path& calibration, Console& console)
{
  const auto undistorted =
    std::count_if(plan.begin(), plan.end(), [](const Conversion& each) { return each.Undistort; });
  const auto masks = std::count_if(
    plan.begin(), plan.end(), [](const Conversion& each) { return !each.To.Mask.empty(); });
  console.Info(std::to_string(plan.size()) + " photographs (" + std::to_string(undistorted) +
    " undistorted), " + std::to_string(masks) + " masks");
  console.Info("calibration: " + calibration.string());
  console.Summary();
}
}

void ConvertDataset(const ConvertOptions& options, Console& console)
{
  const DatasetFormat& format = FormatOf(options.Format);
  const DatasetIndex index = ReadDatasetIndex(options.Dataset, options.Source);
  WarnOf(index, console);
  std::vector<Photograph> photographs = WithoutExcluded(index, options.Exclude);
  MendRotations(index, photographs, console);
  if (options.RefineCameras)
  {
    RefinePoses(index, options.Exclude, photographs, console);
  }
  const bool held = std::all_of(photographs.begin(), photographs.end(), format.HoldsLens);
  std::vector<Conversion> plan = Plan(photographs, options.Undistort || !held);
  const std::string folderName =
    fs::weakly_canonical(fs::absolute(options.Out)).filename().string();
  const std::string name = folderName.empty() ? "cameras" : folderName;
  // Once before anything is written: the format may not hold these cameras.
  const std::vector<FileContent> planned = format.Compose(name, Written(plan));
  CheckFolder(options.Dataset, options.Out, planned);
  AnnounceFiles(plan, format, planned, options.Out);
  console.Progress("writing photographs", 0);
  ParallelForEach(
    plan.size(), [&](std::size_t i) { Transfer(plan[i], format, options.Out); },
    console.ProgressOf("writing photographs"));
  const std::vector<FileContent> files = format.Compose(name, Written(plan));
  for (const FileContent& file : files)
  {
    WriteTextAtomically(options.Out / file.Path, file.Bytes);
  }
  Report(plan, options.Out / files.back().Path, console);
}
}
