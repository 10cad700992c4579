// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/Middlebury.h"

#include "ViewAccess.h"
#include "base/AtomicFile.h"
#include "base/InputFile.h"
#include "base/NumberText.h"
#include "cameras/PhotographFiles.h"
#include "core/Error.h"
#include "images/ImageFile.h"

#include <vtkImageData.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
constexpr std::size_t NumbersPerLine = 21;

/** A line, with its place as Where. */
Photograph ParseLine(const std::vector<std::string>& words, const std::string& where)
{
  if (words.size() != NumbersPerLine + 1)
  {
    throw Error(where,
      words.size() <= NumbersPerLine ? "calibration line is short" : "calibration line is long",
      std::to_string(words.size() - 1) + " values after the file name", "21: K (9), R (9), t (3)");
  }
  double values[NumbersPerLine];
  for (std::size_t i = 0; i < NumbersPerLine; ++i)
  {
    if (!ParseNumber(words[i + 1], values[i]))
    {
      throw Error(where, "value " + std::to_string(i + 1) + " of " + words[0] + " is not a number",
        "'" + words[i + 1] + "'", "a number");
    }
  }
  using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  Photograph result;
  result.Name = words[0];
  result.Cam.K = Eigen::Map<const RowMajor3>(values);
  result.Cam.R = Eigen::Map<const RowMajor3>(values + 9);
  result.Cam.T = Eigen::Map<const Eigen::Vector3d>(values + 18);
  result.Where = where + " (" + result.Name + ")";
  return result;
}

std::size_t ParseCount(const std::vector<std::string>& words, const std::string& where)
{
  std::size_t count = 0;
  if (words.size() != 1 || !ParseNumber(words[0], count))
  {
    throw Error(where, "first line is not a count of photographs",
      words.empty() ? "nothing" : "'" + words[0] + (words.size() > 1 ? " ...'" : "'"),
      "a whole number alone");
  }
  return count;
}

/** The lines of a calibration file as they are. */
std::vector<Photograph> ReadLines(const fs::path& parFile)
{
  std::istringstream file(ReadInputText(parFile));
  std::vector<Photograph> cameras;
  std::set<std::string> names;
  std::size_t count = 0;
  int lineNumber = 0;
  bool counted = false;
  for (std::string line; std::getline(file, line);)
  {
    const std::string where = parFile.string() + ", line " + std::to_string(++lineNumber);
    const std::vector<std::string> words = Words(line);
    if (!counted)
    {
      count = ParseCount(words, where);
      counted = true;
    }
    else if (!words.empty())
    {
      cameras.push_back(ParseLine(words, where));
      if (!names.insert(cameras.back().Name).second)
      {
        throw Error(where, "photograph " + cameras.back().Name + " is there twice");
      }
    }
  }
  if (!counted)
  {
    throw Error(parFile.string(), "calibration file is empty");
  }
  if (cameras.size() != count)
  {
    throw Error(parFile.string(), "number of calibration lines is not the count in line 1",
      std::to_string(cameras.size()), std::to_string(count));
  }
  return cameras;
}

Calibration ReadMiddlebury(const fs::path& folder, const fs::path& parFile)
{
  Calibration calibration{ ProjectConvention(), ReadLines(parFile) };
  for (Photograph& photograph : calibration.Photographs)
  {
    photograph.File = folder / photograph.Name;
  }
  return calibration;
}

/** A calibration file; `where` is for messages. */
std::string ParText(const std::vector<NamedCamera>& cameras, const std::string& where)
{
  std::string text = std::to_string(cameras.size()) + "\n";
  for (const NamedCamera& camera : cameras)
  {
    if (Words(camera.Name).size() != 1 || Words(camera.Name).front() != camera.Name)
    {
      throw Error(where, "a file name with blanks cannot be written", "'" + camera.Name + "'",
        "a name without blanks");
    }
    text += camera.Name;
    for (const Eigen::Matrix3d* matrix : { &camera.Cam.K, &camera.Cam.R })
    {
      for (int i = 0; i < 9; ++i)
      {
        text += " " + NumberText((*matrix)(i / 3, i % 3));
      }
    }
    for (int i = 0; i < 3; ++i)
    {
      text += " " + NumberText(camera.Cam.T[i]);
    }
    text += "\n";
  }
  return text;
}
}

std::vector<NamedCamera> ReadCameras(const fs::path& parFile)
{
  std::vector<NamedCamera> cameras;
  for (const Photograph& line : ReadLines(parFile))
  {
    ValidateCalibration(line.Cam, line.Where);
    cameras.push_back(line);
  }
  return cameras;
}

void WriteCameras(const fs::path& parFile, const std::vector<NamedCamera>& cameras)
{
  WriteTextAtomically(parFile, ParText(cameras, parFile.string()));
}

std::vector<std::string> ParFilesIn(const fs::path& folder)
{
  std::vector<std::string> found;
  for (const fs::path& file : FilesIn(folder))
  {
    const std::string name = file.filename().string();
    if (name.ends_with("_par.txt"))
    {
      found.push_back(name);
    }
  }
  return found;
}

void WriteDataset(vtkMultiBlockDataSet* views, const fs::path& folder, const std::string& name)
{
  std::vector<NamedCamera> cameras;
  for (unsigned int viewId = 0; viewId < views->GetNumberOfBlocks(); ++viewId)
  {
    const std::string file = ViewName(views, viewId);
    vtkImageData* image = ViewImage(views, viewId);
    cameras.push_back({ file, AttachedCamera(image, "view " + file) });
    WriteArray(folder / file, image, arrays::Color);
    WriteArray(folder / "mask" / file, image, arrays::Mask);
  }
  // Last, so that an interrupted writing leaves no data set that looks complete.
  WriteCameras(folder / (name + "_par.txt"), cameras);
}

DatasetFormat MiddleburyFormat()
{
  DatasetFormat format;
  format.Name = "middlebury";
  format.LookedFor = "*_par.txt";
  format.Find = [](const fs::path& folder)
  {
    std::vector<fs::path> files;
    for (const std::string& name : ParFilesIn(folder))
    {
      files.push_back(folder / name);
    }
    return files;
  };
  format.Accepts = [](const fs::path& file)
  {
    // Any name will do but those that COLMAP gives.
    return LowerCase(file.extension().string()) == ".txt" &&
      LowerCase(file.filename().string()) != "images.txt" &&
      LowerCase(file.filename().string()) != "cameras.txt";
  };
  format.Read = ReadMiddlebury;
  format.MaskFolder = "mask";
  format.MaskName = [](const std::string& name)
  { return fs::path(name).replace_extension(".png").string(); };
  format.HoldsLens = [](const Photograph& photograph) { return photograph.Distortion.IsPinhole(); };
  format.Compose = [](const std::string& name, const std::vector<Photograph>& photographs)
  {
    const std::string file = name + "_par.txt";
    return std::vector<FileContent>{ { file,
      ParText({ photographs.begin(), photographs.end() }, file) } };
  };
  return format;
}
}
