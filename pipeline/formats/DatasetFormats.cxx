// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/DatasetFormats.h"

#include "base/NumberText.h"
#include "core/Error.h"
#include "formats/BouguetCalibration.h"
#include "formats/Colmap.h"
#include "formats/ForeignCalibrations.h"
#include "formats/Middlebury.h"
#include "formats/MvsNet.h"
#include "formats/NerfTransforms.h"
#include "formats/NumpyCalibration.h"
#include "formats/OpenCvCalibration.h"

#include <algorithm>

namespace novelview
{
namespace fs = std::filesystem;

const std::vector<DatasetFormat>& DatasetFormats()
{
  static const std::vector<DatasetFormat> formats{ MiddleburyFormat(), ColmapTextFormat(),
    ColmapBinaryFormat(), NerfFormat(), OpenCvFormat(), BouguetFormat(), NeusFormat(), LlffFormat(),
    MvsNetFormat(), NumpyFormat() };
  return formats;
}

std::vector<std::string> DatasetFormatNames()
{
  std::vector<std::string> names;
  for (const DatasetFormat& format : DatasetFormats())
  {
    names.push_back(format.Name);
  }
  return names;
}

std::vector<std::string> WritableFormatNames()
{
  std::vector<std::string> names;
  for (const DatasetFormat& format : DatasetFormats())
  {
    if (format.Compose)
    {
      names.push_back(format.Name);
    }
  }
  return names;
}

const DatasetFormat& FormatOf(const std::string& name)
{
  for (const DatasetFormat& format : DatasetFormats())
  {
    if (format.Name == name)
    {
      return format;
    }
  }
  throw Error("format", "unknown", "'" + name + "'", Joined(DatasetFormatNames()));
}

std::vector<FoundCalibration> CalibrationsIn(const fs::path& folder, const std::string& format)
{
  std::vector<FoundCalibration> found;
  for (const DatasetFormat& each : DatasetFormats())
  {
    if (format != "auto" && format != each.Name)
    {
      continue;
    }
    for (const fs::path& file : each.Find(folder))
    {
      // A binary COLMAP model is one of both COLMAP formats.
      if (std::none_of(found.begin(), found.end(),
            [&file](const FoundCalibration& other) { return other.File == file; }))
      {
        found.push_back({ &each, file });
      }
    }
  }
  return found;
}

FoundCalibration ChooseCalibration(
  const fs::path& folder, const fs::path& calibration, const std::string& format)
{
  if (!calibration.empty())
  {
    for (const DatasetFormat& each : DatasetFormats())
    {
      if (format == each.Name || (format == "auto" && each.Accepts(calibration)))
      {
        return { &each, calibration };
      }
    }
    const std::string foreign = ForeignFile(calibration);
    throw Error(calibration.string(),
      foreign.empty() ? "is not a calibration that is recognised by its name" : foreign);
  }
  const std::vector<FoundCalibration> found = CalibrationsIn(folder, format);
  if (found.size() == 1)
  {
    return found.front();
  }
  std::vector<std::string> known;
  for (const DatasetFormat& each : DatasetFormats())
  {
    // A binary COLMAP model is one of both COLMAP formats.
    if (format == each.Name || (format == "auto" && each.Name != "colmap-binary"))
    {
      known.push_back(each.LookedFor + " (" + each.Name + ")");
    }
  }
  std::vector<std::string> names;
  for (const FoundCalibration& each : found)
  {
    names.push_back(each.File.lexically_relative(folder).string() + " (" + each.Format->Name + ")");
  }
  const std::string foreign = found.empty() ? ForeignFilesIn(folder) : "";
  throw Error(folder.string(),
    found.empty() ? "no calibration file" + (foreign.empty() ? "" : "; " + foreign)
                  : "several calibration files, choose one by --calibration or --format",
    found.empty() ? "none" : Joined(names),
    foreign.empty() ? "one of " + Joined(known) : "a calibration of a format of --format");
}
}
