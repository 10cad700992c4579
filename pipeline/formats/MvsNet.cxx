// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/MvsNet.h"

#include "base/InputFile.h"
#include "base/NumberText.h"
#include "cameras/PhotographFiles.h"
#include "core/Error.h"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
const char* const Ending = "_cam.txt";

std::vector<fs::path> CameraFiles(const fs::path& folder)
{
  std::vector<fs::path> files;
  for (const fs::path& file : FilesIn(folder))
  {
    if (file.filename().string().ends_with(Ending))
    {
      files.push_back(file);
    }
  }
  return files;
}

/** The numbers behind a word. */
template <std::size_t Count>
std::array<double, Count> NumbersBehind(
  const std::string& text, const std::string& word, const std::string& where)
{
  const std::size_t at = text.find(word);
  std::istringstream stream(at == std::string::npos ? "" : text.substr(at + word.size()));
  stream.imbue(std::locale::classic());
  std::array<double, Count> numbers{};
  for (double& number : numbers)
  {
    if (!(stream >> number))
    {
      throw Error(
        where, "has too few numbers behind \"" + word + "\"", "fewer", std::to_string(Count));
    }
  }
  return numbers;
}

/** The photographs of the folders they may lie in, by stem; of several the first. */
std::map<fs::path, fs::path> PhotographsByStem(const fs::path& folder)
{
  std::map<fs::path, fs::path> photographs;
  for (const char* place : { "images", "blended_images", "" })
  {
    const fs::path in = *place ? folder / place : folder;
    for (const std::string& name : PhotographsIn(in))
    {
      photographs.emplace(fs::path(name).stem(), in / name);
    }
  }
  return photographs;
}

Calibration ReadMvsNet(const fs::path& folder, const fs::path& cameras)
{
  Calibration calibration;
  calibration.Convention = ProjectConvention();
  const std::map<fs::path, fs::path> photographs = PhotographsByStem(folder);
  for (const fs::path& file : CameraFiles(cameras))
  {
    const std::string text = ReadInputText(file);
    const auto pose = NumbersBehind<16>(text, "extrinsic", file.string());
    const auto K = NumbersBehind<9>(text, "intrinsic", file.string());
    std::string stem = file.filename().string();
    stem.resize(stem.size() - std::string(Ending).size());
    Photograph photograph;
    const auto found = photographs.find(stem);
    photograph.File =
      found == photographs.end() ? folder / "images" / (stem + ".jpg") : found->second;
    photograph.Name = photograph.File.filename().string();
    photograph.Where = file.string();
    photograph.Cam.K = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(K.data());
    const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(pose.data());
    photograph.Cam.R = matrix.topLeftCorner<3, 3>();
    photograph.Cam.T = matrix.topRightCorner<3, 1>();
    calibration.Photographs.push_back(photograph);
  }
  return calibration;
}

/** A row of numbers with blanks between. */
template <class Row>
std::string RowText(const Row& row)
{
  std::string text;
  for (int i = 0; i < row.size(); ++i)
  {
    text += NumberText(row[i]) + (i + 1 < row.size() ? " " : "\n");
  }
  return text;
}

std::vector<FileContent> ComposeMvsNet(
  const std::string&, const std::vector<Photograph>& photographs)
{
  std::vector<FileContent> files;
  for (const Photograph& photograph : photographs)
  {
    const fs::path name(photograph.Name);
    if (name.has_parent_path())
    {
      throw Error("view " + photograph.Name, "the format mvsnet has no subfolders", photograph.Name,
        name.filename().string());
    }
    const Camera& camera = photograph.Cam;
    std::string text = "extrinsic\n";
    for (int row = 0; row < 3; ++row)
    {
      text += RowText(
        Eigen::Vector4d(camera.R(row, 0), camera.R(row, 1), camera.R(row, 2), camera.T[row]));
    }
    text += "0 0 0 1\n\nintrinsic\n";
    for (int row = 0; row < 3; ++row)
    {
      text += RowText(camera.K.row(row));
    }
    files.push_back({ fs::path("cams") / (name.stem().string() + Ending), text });
  }
  return files;
}
}

DatasetFormat MvsNetFormat()
{
  DatasetFormat format;
  format.Name = "mvsnet";
  format.LookedFor = "cams/";
  format.Find = [](const fs::path& folder)
  {
    const fs::path cameras = FileOfAnyCase(folder / "cams");
    return CameraFiles(cameras).empty() ? std::vector<fs::path>() : std::vector{ cameras };
  };
  format.Accepts = [](const fs::path& path) { return !CameraFiles(path).empty(); };
  format.Read = ReadMvsNet;
  format.PhotoFolder = "images";
  format.MaskFolder = "masks";
  format.MaskName = [](const std::string& name) { return name + ".png"; };
  format.HoldsLens = [](const Photograph& photograph) { return photograph.Distortion.IsPinhole(); };
  format.Compose = ComposeMvsNet;
  return format;
}
}
