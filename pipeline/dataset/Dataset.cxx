// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset/Dataset.h"

#include "ViewAccess.h"
#include "base/InputFile.h"
#include "base/NumberText.h"
#include "base/Parallel.h"
#include "cameras/CameraGrid.h"
#include "cameras/CameraLimits.h"
#include "core/Error.h"
#include "dataset/DatasetFiles.h"
#include "dataset/ExifDecision.h"
#include "dataset/PhotographSize.h"
#include "formats/DatasetFormats.h"
#include "formats/ForeignCalibrations.h"
#include "images/ExifOrientation.h"
#include "images/ImageFile.h"
#include "images/MaskImage.h"
#include "silhouettes/ContourDistance.h"

#include <vtkImageData.h>

#include <algorithm>
#include <set>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/** Throws where a camera is none; its size may be unknown, 0x0. */
void CheckCamera(const Photograph& photograph)
{
  const Camera& camera = photograph.Cam;
  if (camera.Width == 0 && camera.Height == 0)
  {
    ValidateCalibration(camera, photograph.Where);
    return;
  }
  if (camera.Width > MaxExtentPx || camera.Height > MaxExtentPx)
  {
    throw Error(photograph.Where, "image size is out of range",
      SizeText(camera.Width, camera.Height), "sides of at most " + std::to_string(MaxExtentPx));
  }
  ValidateCamera(camera, photograph.Where);
}

/** Throws where a camera in the project's convention is none, or a name is there twice. */
void CheckCameras(const std::vector<Photograph>& photographs, const fs::path& calibration)
{
  if (photographs.empty())
  {
    throw Error(calibration.string(), "calibration contains no camera");
  }
  std::set<std::string> names;
  for (const Photograph& photograph : photographs)
  {
    CheckCamera(photograph);
    ValidateLens(photograph.Distortion, photograph.Where);
    if (!names.insert(photograph.Name).second)
    {
      throw Error(photograph.Where, "photograph " + photograph.Name + " is there twice");
    }
  }
}

void Invert(Image<std::uint8_t>& mask)
{
  for (std::uint8_t& value : mask.Values)
  {
    value = static_cast<std::uint8_t>(255 - value);
  }
}

void CheckSize(const Image<std::uint8_t>& mask, int width, int height, const fs::path& maskFile)
{
  if (mask.Width != width || mask.Height != height)
  {
    throw Error(maskFile.string(), "mask has another size than its photograph",
      SizeText(mask.Width, mask.Height), SizeText(width, height));
  }
}

/** A text without its numbers, by which warnings are alike. */
std::string WithoutNumbers(std::string text)
{
  std::erase_if(text, [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
  return text;
}

/** One photograph, read and prepared. */
struct Prepared
{
  vtkSmartPointer<vtkImageData> Block;
  Coverage Covered;
  std::vector<std::string> Warnings;
  bool Extracted = false;
};

Prepared Prepare(const Photograph& photograph, const DatasetOptions& options)
{
  const PhotographPixels pixels =
    ReadPhotograph(photograph, options.ForceSilhouettes, options.Silhouette);
  const Image<std::uint8_t>& mask = pixels.Mask;
  Camera camera = photograph.Cam;
  camera.Width = mask.Width;
  camera.Height = mask.Height;
  ValidateCamera(camera, photograph.Where);
  Prepared result;
  result.Extracted = pixels.Source == MaskSource::Extracted;
  result.Covered = MeasureCoverage(mask.Ref());
  result.Warnings = pixels.Warnings;
  const std::string where = "view " + photograph.Name;
  for (const std::string& warning : CheckCoverage(result.Covered, where))
  {
    result.Warnings.push_back(warning.substr(where.size() + 2));
  }
  result.Block = NewImage(mask.Width, mask.Height);
  SetPixels(result.Block, arrays::Color, pixels.Color.Ref());
  SetPixels(result.Block, arrays::Mask, mask.Ref());
  const Image<float> distance = SignedContourDistance(mask.Ref());
  SetPixels(result.Block, arrays::ContourDistance, distance.Ref());
  return result;
}

void CheckSizes(std::vector<Photograph> cameras, const std::vector<Prepared>& prepared)
{
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    int size[3];
    prepared[i].Block->GetDimensions(size);
    cameras[i].Cam.Width = size[0];
    cameras[i].Cam.Height = size[1];
  }
  RequireOneSizePerK(cameras);
}

/** Reports which photographs have no mask although others have one. */
std::string MissingMasks(
  const std::vector<Photograph>& cameras, const std::vector<Prepared>& prepared)
{
  std::string names;
  bool any = false;
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    any |= !prepared[i].Extracted;
    names += prepared[i].Extracted ? (names.empty() ? "" : ", ") + cameras[i].Name : "";
  }
  return any && !names.empty() ? "no mask, silhouette extracted: " + names : "";
}

/** The warnings of all views; those that are alike become one, with the first names and the count. */
std::vector<std::string> Grouped(
  const std::vector<Photograph>& cameras, const std::vector<Prepared>& prepared)
{
  constexpr std::size_t named = 3;
  std::vector<std::pair<std::string, std::vector<std::string>>> groups; // text, names
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    for (const std::string& text : prepared[i].Warnings)
    {
      const auto same = std::find_if(groups.begin(), groups.end(),
        [&](const auto& group) { return WithoutNumbers(group.first) == WithoutNumbers(text); });
      (same == groups.end() ? groups.emplace_back(text, std::vector<std::string>()) : *same)
        .second.push_back(cameras[i].Name);
    }
  }
  std::vector<std::string> warnings;
  for (auto& [text, names] : groups)
  {
    const std::size_t count = names.size();
    names.resize(std::min(count, named));
    warnings.push_back((count == 1 ? "view " : std::to_string(count) + " views (") + Joined(names) +
      (count > named ? " .." : "") + (count == 1 ? ": " : "): ") + text);
  }
  return warnings;
}

/** What a calibration names is an input, whether it is read or left out. */
void ProtectInputs(const fs::path& calibration, const std::vector<Photograph>& photographs)
{
  ProtectInput(calibration);
  for (const Photograph& photograph : photographs)
  {
    ProtectInput(photograph.File);
    ProtectInput(photograph.Mask);
  }
}
}

DatasetIndex ReadDatasetIndex(const fs::path& folder, const DatasetSource& source)
{
  std::error_code failure;
  if (!fs::is_directory(folder, failure))
  {
    if (!fs::exists(folder, failure))
    {
      throw Error(folder.string(), "no such folder");
    }
    const std::string foreign = ForeignFile(folder);
    throw Error(folder.string(),
      foreign.empty()
        ? "is a file, not the folder of a data set; give the folder, and the file with "
          "--calibration"
        : foreign);
  }
  const FoundCalibration found = ChooseCalibration(folder, source.Calibration, source.Format);
  Calibration calibration = found.Format->Read(folder, found.File);
  FindFilesMeant(folder, calibration.Photographs, calibration.Notes);
  ApplyConvention(Override(calibration.Convention, source.Convention), calibration.Photographs);
  CheckCameras(calibration.Photographs, found.File);
  FindMasks(folder, calibration.Photographs, calibration.Notes);
  NotePhotographsWithoutCamera(folder, calibration.Photographs, calibration.Notes);
  ProtectInputs(found.File, calibration.Photographs);
  DatasetIndex index{ folder, found.File, found.Format->Name, source,
    std::move(calibration.Photographs), std::move(calibration.Notes) };
  for (Photograph& photograph : index.Cameras)
  {
    photograph.Reading.WhiteLevel = source.WhiteLevel.value_or(0);
  }
  DecideExifOrientation(source.ExifOrientation, index.Cameras, index.Notes);
  return index;
}

std::vector<Photograph> ReadViewCameras(const fs::path& calibration)
{
  const fs::path folder = calibration.has_parent_path() ? calibration.parent_path() : ".";
  const FoundCalibration found = ChooseCalibration(folder, calibration, "auto");
  Calibration read = found.Format->Read(folder, found.File);
  ApplyConvention(read.Convention, read.Photographs);
  CheckCameras(read.Photographs, found.File);
  FindMasks(folder, read.Photographs, read.Notes);
  ProtectInputs(found.File, read.Photographs);
  return read.Photographs;
}

std::vector<Photograph> WithoutExcluded(
  const DatasetIndex& index, const std::vector<std::string>& exclude)
{
  std::set<std::string> excluded;
  for (const std::string& name : exclude)
  {
    const Photograph* const photograph = PhotographOfName(index.Cameras, name);
    if (!photograph)
    {
      throw Error(index.Calibration.string(), "no photograph of the name to exclude: " + name);
    }
    excluded.insert(photograph->Name);
  }
  std::vector<Photograph> kept;
  for (const Photograph& camera : index.Cameras)
  {
    if (!excluded.contains(camera.Name))
    {
      kept.push_back(camera);
    }
  }
  if (kept.empty())
  {
    throw Error(index.Calibration.string(), "no photograph left");
  }
  return kept;
}

Image<std::uint8_t> ReadGivenMask(const Photograph& photograph)
{
  Image<std::uint8_t> mask = photograph.Mask.empty()
    ? ReadAlphaFile(photograph.File, photograph.Reading.Orientation)
    : ReadMaskFile(photograph.Mask);
  if (photograph.InvertMask)
  {
    Invert(mask);
  }
  return mask;
}

namespace
{
/** Throws when a photograph has another size than its calibration says. */
void CheckSize(const Image<std::uint8_t>& color, const Photograph& photograph)
{
  const bool reduced = photograph.FileWidth > 0;
  const int width = reduced ? photograph.FileWidth : photograph.Cam.Width;
  const int height = reduced ? photograph.FileHeight : photograph.Cam.Height;
  if (width > 0 && (color.Width != width || color.Height != height))
  {
    const int tag = ReadExifOrientation(photograph.File);
    throw Error(photograph.File.string(),
      "photograph has another size than its calibration" +
        (tag == 1 ? ""
                  : ", with its EXIF orientation tag (" + std::to_string(tag) + ") " +
              (photograph.Reading.Orientation == 1 ? "ignored" : "applied")),
      SizeText(color.Width, color.Height), SizeText(width, height));
  }
}
}

PhotographPixels ReadPhotograph(
  const Photograph& photograph, bool forceSilhouette, const SilhouetteOptions& silhouette)
{
  PhotographPixels pixels;
  pixels.Color = ReadColorFile(photograph.File, photograph.Reading, &pixels.Warnings);
  CheckSize(pixels.Color, photograph);
  if (!forceSilhouette)
  {
    pixels.Mask = ReadGivenMask(photograph);
    pixels.Source = photograph.Mask.empty() ? MaskSource::Alpha : MaskSource::File;
  }
  if (!pixels.Mask.Values.empty())
  {
    CheckSize(pixels.Mask, pixels.Color.Width, pixels.Color.Height, photograph.Mask);
  }
  const Camera& camera = photograph.Cam;
  if (photograph.FileWidth > 0)
  {
    pixels.Color = ReducedImage(pixels.Color.Ref(), camera.Width, camera.Height);
    pixels.Mask = ReducedImage(pixels.Mask.Ref(), camera.Width, camera.Height);
  }
  if (pixels.Mask.Values.empty())
  {
    // From the photograph as it is: the border that undistorting exposes is no background.
    pixels.Mask = ExtractSilhouette(pixels.Color.Ref(), silhouette);
    pixels.Source = MaskSource::Extracted;
  }
  if (!photograph.Distortion.IsPinhole())
  {
    pixels.Color = Undistorted(pixels.Color.Ref(), photograph.Distortion, camera.K);
    pixels.Mask = Undistorted(pixels.Mask.Ref(), photograph.Distortion, camera.K);
  }
  return pixels;
}

Dataset ReadDataset(const DatasetIndex& index, const DatasetOptions& options,
  const std::function<void(double fraction)>& progress)
{
  const std::vector<Photograph> cameras = WithoutExcluded(index, options.Exclude);
  std::vector<Prepared> prepared(cameras.size());
  ParallelForEach(
    cameras.size(), [&](std::size_t i) { prepared[i] = Prepare(cameras[i], options); }, progress);
  CheckSizes(cameras, prepared);
  Dataset dataset;
  dataset.Views = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (const ReadingNote& note : index.Notes)
  {
    dataset.Warnings.push_back(note.Text);
  }
  const CameraGrid grid(index.Cameras);
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    AppendView(dataset.Views, cameras[i].Name, prepared[i].Block, grid.Rounded(cameras[i].Cam));
    dataset.Coverages.push_back(prepared[i].Covered);
  }
  const std::vector<std::string> warnings = Grouped(cameras, prepared);
  dataset.Warnings.insert(dataset.Warnings.end(), warnings.begin(), warnings.end());
  const std::string missing = MissingMasks(cameras, prepared);
  if (!missing.empty())
  {
    dataset.Warnings.push_back(missing);
  }
  return dataset;
}
}
