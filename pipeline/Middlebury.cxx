// SPDX-License-Identifier: GPL-3.0-or-later
#include "Middlebury.h"

#include "AtomicFile.h"
#include "ContourDistance.h"
#include "Error.h"
#include "ImageFile.h"
#include "Parallel.h"
#include "ViewAccess.h"

#include <vtkImageData.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <set>
#include <sstream>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
constexpr std::size_t NumbersPerLine = 21;

std::vector<std::string> Words(const std::string& line)
{
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;)
  {
    words.push_back(word);
  }
  return words;
}

/** The whole text as a number, whatever the locale. */
template <class T>
bool ParseNumber(const std::string& text, T& number)
{
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(begin, end, number);
  return failure == std::errc() && stop == end;
}

NamedCamera ParseLine(const std::vector<std::string>& words, const std::string& where)
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
      throw Error(where, "value " + std::to_string(i + 1) + " of " + words[0] + " is no number",
        "'" + words[i + 1] + "'", "a number");
    }
  }
  using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  NamedCamera result;
  result.Name = words[0];
  result.Cam.K = Eigen::Map<const RowMajor3>(values);
  result.Cam.R = Eigen::Map<const RowMajor3>(values + 9);
  result.Cam.T = Eigen::Map<const Eigen::Vector3d>(values + 18);
  Camera sized = result.Cam;
  sized.Width = sized.Height = 1;
  ValidateCamera(sized, where + " (" + result.Name + ")");
  return result;
}

std::size_t ParseCount(const std::vector<std::string>& words, const std::string& where)
{
  std::size_t count = 0;
  if (words.size() != 1 || !ParseNumber(words[0], count))
  {
    throw Error(where, "first line is no count of photographs",
      words.empty() ? "nothing" : "'" + words[0] + (words.size() > 1 ? " ...'" : "'"),
      "a whole number alone");
  }
  return count;
}

std::string NumberText(double value)
{
  // The shortest text that reads back as the same bits.
  char text[64];
  return std::string(text, std::to_chars(text, text + sizeof(text), value).ptr);
}

fs::path FindParFile(const fs::path& folder)
{
  const std::vector<std::string> found = ParFilesIn(folder);
  if (found.size() != 1)
  {
    std::string names;
    for (const std::string& name : found)
    {
      names += (names.empty() ? "" : ", ") + name;
    }
    throw Error(folder.string(),
      found.empty() ? "no calibration file" : "several calibration files, choose one",
      found.empty() ? "none" : names, "one *_par.txt");
  }
  return folder / found.front();
}

/** One photograph, read and prepared. */
struct Prepared
{
  vtkSmartPointer<vtkImageData> Block;
  Coverage Covered;
  std::vector<std::string> Warnings;
  bool Extracted = false;
};

Prepared Prepare(const DatasetIndex& index, const NamedCamera& named, const DatasetOptions& options)
{
  const fs::path file = index.Folder / named.Name;
  const Image<std::uint8_t> photo = ReadColorFile(file);
  const fs::path maskFile =
    options.ForceSilhouettes ? fs::path() : MaskFileOf(index.Folder, named.Name);
  Prepared result;
  result.Extracted = maskFile.empty();
  const Image<std::uint8_t> mask =
    result.Extracted ? ExtractSilhouette(photo.Ref(), options.Silhouette) : ReadGreyFile(maskFile);
  if (mask.Width != photo.Width || mask.Height != photo.Height)
  {
    throw Error(maskFile.string(), "mask has another size than its photograph",
      SizeText(mask.Width, mask.Height), SizeText(photo.Width, photo.Height));
  }
  result.Covered = MeasureCoverage(mask.Ref());
  result.Warnings = CheckCoverage(result.Covered, "view " + named.Name);
  result.Block = NewImage(photo.Width, photo.Height);
  SetPixels(result.Block, arrays::Color, photo.Ref());
  SetPixels(result.Block, arrays::Mask, mask.Ref());
  const Image<float> distance = SignedContourDistance(mask.Ref());
  SetPixels(result.Block, arrays::ContourDistance, distance.Ref());
  return result;
}

std::vector<NamedCamera> WithoutExcluded(
  const DatasetIndex& index, const std::vector<std::string>& exclude)
{
  std::vector<NamedCamera> kept;
  std::set<std::string> unknown(exclude.begin(), exclude.end());
  for (const NamedCamera& camera : index.Cameras)
  {
    unknown.erase(camera.Name);
    if (std::find(exclude.begin(), exclude.end(), camera.Name) == exclude.end())
    {
      kept.push_back(camera);
    }
  }
  if (!unknown.empty())
  {
    throw Error(
      index.ParFile.string(), "no photograph of the name to exclude: " + *unknown.begin());
  }
  if (kept.empty())
  {
    throw Error(index.ParFile.string(), "no photograph left");
  }
  return kept;
}

/**
 * A photograph that was resized after its calibration would carve the object away. It shows where
 * another photograph has the same K.
 */
void CheckSizes(const std::vector<NamedCamera>& cameras, const std::vector<Prepared>& prepared)
{
  for (std::size_t i = 1; i < cameras.size(); ++i)
  {
    int size[2][3];
    for (std::size_t j = 0; j < i; ++j)
    {
      prepared[i].Block->GetDimensions(size[0]);
      prepared[j].Block->GetDimensions(size[1]);
      if (cameras[i].Cam.K == cameras[j].Cam.K &&
        (size[0][0] != size[1][0] || size[0][1] != size[1][1]))
      {
        throw Error("view " + cameras[i].Name,
          "photograph has another size than " + cameras[j].Name + ", whose K is the same",
          SizeText(size[0][0], size[0][1]), SizeText(size[1][0], size[1][1]));
      }
    }
  }
}

/** Says which photographs had no mask, when others had. */
std::string MissingMasks(
  const std::vector<NamedCamera>& cameras, const std::vector<Prepared>& prepared)
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
}

std::vector<NamedCamera> ReadCameras(const fs::path& parFile)
{
  std::ifstream file(parFile);
  if (!file)
  {
    throw Error(parFile.string(), "calibration file cannot be read");
  }
  std::vector<NamedCamera> cameras;
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

void WriteCameras(const fs::path& parFile, const std::vector<NamedCamera>& cameras)
{
  std::string text = std::to_string(cameras.size()) + "\n";
  for (const NamedCamera& camera : cameras)
  {
    if (Words(camera.Name).size() != 1 || Words(camera.Name).front() != camera.Name)
    {
      throw Error(parFile.string(), "a file name with blanks cannot be written",
        "'" + camera.Name + "'", "a name without blanks");
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
  WriteTextAtomically(parFile, text);
}

std::vector<std::string> ParFilesIn(const fs::path& folder)
{
  std::vector<std::string> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
  {
    const std::string name = entry.path().filename().string();
    if (name.ends_with("_par.txt") && entry.is_regular_file())
    {
      found.push_back(name);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

DatasetIndex ReadDatasetIndex(const fs::path& folder, const fs::path& parFile)
{
  std::error_code failure;
  if (!fs::is_directory(folder, failure))
  {
    throw Error(folder.string(), "no such folder");
  }
  DatasetIndex index;
  index.Folder = folder;
  index.ParFile = parFile.empty() ? FindParFile(folder) : parFile;
  index.Cameras = ReadCameras(index.ParFile);
  return index;
}

fs::path MaskFileOf(const fs::path& folder, const std::string& name)
{
  std::error_code failure;
  const fs::path same = folder / "mask" / name;
  const fs::path png = fs::path(same).replace_extension(".png");
  for (const fs::path& file : { same, png })
  {
    if (fs::exists(file, failure))
    {
      return file;
    }
  }
  return {};
}

Dataset ReadDataset(const DatasetIndex& index, const DatasetOptions& options)
{
  const std::vector<NamedCamera> cameras = WithoutExcluded(index, options.Exclude);
  std::vector<Prepared> prepared(cameras.size());
  ParallelForEach(
    cameras.size(), [&](std::size_t i) { prepared[i] = Prepare(index, cameras[i], options); });
  CheckSizes(cameras, prepared);
  Dataset dataset;
  dataset.Views = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    AppendView(dataset.Views, cameras[i].Name, prepared[i].Block, cameras[i].Cam);
    dataset.Coverages.push_back(prepared[i].Covered);
    dataset.Warnings.insert(
      dataset.Warnings.end(), prepared[i].Warnings.begin(), prepared[i].Warnings.end());
  }
  const std::string missing = MissingMasks(cameras, prepared);
  if (!missing.empty())
  {
    dataset.Warnings.push_back(missing);
  }
  return dataset;
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
}
