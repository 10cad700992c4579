// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/NumpyCalibration.h"

#include "base/InputFile.h"
#include "base/NumberText.h"
#include "cameras/PhotographFiles.h"
#include "core/Error.h"
#include "formats/NumpyArrays.h"
#include "formats/ProjectionMatrix.h"
#include "images/ImageFile.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
using Arrays = std::map<std::string, NumpyArray>;
using RowMatrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/** The photographs of the first of some folders that has any; as many as there are cameras. */
std::vector<Photograph> PhotographsOf(
  const fs::path& folder, const std::string& calibration, std::size_t cameras)
{
  for (const char* place : { "image", "images", "rgb", "" })
  {
    const fs::path in = *place ? folder / place : folder;
    const std::vector<std::string> names = PhotographsIn(in);
    if (names.empty())
    {
      continue;
    }
    if (names.size() != cameras)
    {
      throw Error(calibration,
        "has another number of cameras than there are photographs in " + in.string(),
        std::to_string(cameras), std::to_string(names.size()));
    }
    std::vector<Photograph> photographs(names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      photographs[i].Name = names[i];
      photographs[i].File = in / names[i];
      photographs[i].Where = calibration + ", camera " + std::to_string(i);
    }
    return photographs;
  }
  throw Error(calibration, "no photographs", "none in the folder, image/, images/ and rgb/",
    std::to_string(cameras));
}

Calibration ReadNeus(const fs::path& folder, const fs::path& file)
{
  const Arrays arrays = ReadNpz(file);
  std::size_t count = 0;
  while (arrays.contains("world_mat_" + std::to_string(count)))
  {
    ++count;
  }
  if (count == 0)
  {
    throw Error(file.string(), "holds no cameras of NeuS", "no array world_mat_0",
      "world_mat_0, world_mat_1 ..");
  }
  Calibration calibration{ ProjectConvention(), PhotographsOf(folder, file.string(), count), {} };
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::string name = "world_mat_" + std::to_string(i);
    const NumpyArray& array = arrays.at(name);
    if (array.Values.size() < 12 || array.Shape.size() != 2 || array.Shape[1] != 4)
    {
      throw Error(file.string() + ", " + name, "has the wrong shape",
        std::to_string(array.Values.size()) + " numbers", "4 x 4 or 3 x 4");
    }
    SetFromProjection(Eigen::Map<const ProjectionMatrix>(array.Values.data()),
      file.string() + ", " + name, calibration.Photographs[i].Cam);
  }
  return calibration;
}

const NumpyArray& ArrayOf(
  const Arrays& arrays, std::initializer_list<std::string> names, const fs::path& file)
{
  for (const std::string& name : names)
  {
    if (const auto found = arrays.find(name); found != arrays.end())
    {
      return found->second;
    }
  }
  std::vector<std::string> there;
  for (const auto& [name, array] : arrays)
  {
    there.push_back(name);
  }
  throw Error(file.string(), "has no array " + Joined(std::vector<std::string>(names), " or "),
    there.empty() ? "no arrays of numbers" : Joined(there), "K, R and t");
}

Calibration ReadNumpy(const fs::path& folder, const fs::path& file)
{
  const Arrays arrays = ReadNpz(file);
  const NumpyArray& R = ArrayOf(arrays, { "R", "rotations" }, file);
  const NumpyArray& t = ArrayOf(arrays, { "t", "T", "translations" }, file);
  const NumpyArray& K = ArrayOf(arrays, { "K", "intrinsics" }, file);
  const std::size_t count = R.Values.size() / 9;
  if (count == 0 || R.Values.size() != 9 * count || t.Values.size() != 3 * count ||
    (K.Values.size() != 9 && K.Values.size() != 9 * count))
  {
    throw Error(file.string(), "arrays do not belong together",
      std::to_string(K.Values.size()) + ", " + std::to_string(R.Values.size()) + " and " +
        std::to_string(t.Values.size()) + " numbers in K, R and t",
      "9 or N x 9, N x 9 and N x 3");
  }
  Calibration calibration{ ProjectConvention(), PhotographsOf(folder, file.string(), count), {} };
  for (std::size_t i = 0; i < count; ++i)
  {
    Camera& camera = calibration.Photographs[i].Cam;
    camera.K = Eigen::Map<const RowMatrix3>(&K.Values[K.Values.size() == 9 ? 0 : 9 * i]);
    camera.R = Eigen::Map<const RowMatrix3>(&R.Values[9 * i]);
    camera.T = Eigen::Map<const Eigen::Vector3d>(&t.Values[3 * i]);
  }
  return calibration;
}

/** K of the file's size, scaled to that of the photograph. */
void SetLlffIntrinsics(
  const Photograph& photograph, double height, double width, double focal, Camera& camera)
{
  const PictureSize size = ReadPictureSize(photograph.File);
  const double scale = size.Width / width;
  if (!(std::abs(size.Height - scale * height) <= 1))
  {
    throw Error(photograph.Where, "is for another shape than the photograph has",
      SizeText(static_cast<int>(width), static_cast<int>(height)),
      SizeText(size.Width, size.Height));
  }
  camera.Width = size.Width;
  camera.Height = size.Height;
  camera.K << scale * focal, 0, size.Width / 2.0, 0, scale * focal, size.Height / 2.0, 0, 0, 1;
}

Calibration ReadLlff(const fs::path& folder, const fs::path& file)
{
  constexpr std::size_t numbers = 17;
  const NumpyArray array = ParseNpy(ReadInputFile(file), file.string());
  const std::size_t count = array.Values.size() / numbers;
  if (array.Shape.size() != 2 || array.Shape[1] != numbers)
  {
    throw Error(file.string(), "has the wrong shape",
      std::to_string(array.Values.size()) + " numbers", "N x 17");
  }
  Calibration calibration{ ProjectConvention(), PhotographsOf(folder, file.string(), count), {} };
  calibration.Convention.PixelCentre = 0.5;
  calibration.Convention.Poses = "camera-to-world";
  for (std::size_t i = 0; i < count; ++i)
  {
    const Eigen::Matrix<double, 3, 5, Eigen::RowMajor> pose =
      Eigen::Map<const Eigen::Matrix<double, 3, 5, Eigen::RowMajor>>(&array.Values[numbers * i]);
    Photograph& photograph = calibration.Photographs[i];
    photograph.Cam.R << pose.col(1), pose.col(0), -pose.col(2);
    photograph.Cam.T = pose.col(3);
    SetLlffIntrinsics(photograph, pose(0, 4), pose(1, 4), pose(2, 4), photograph.Cam);
  }
  return calibration;
}

std::vector<FileContent> ComposeNeus(const std::string&, const std::vector<Photograph>& photographs)
{
  std::vector<const Photograph*> ordered;
  for (const Photograph& photograph : photographs)
  {
    if (fs::path(photograph.Name).has_parent_path())
    {
      throw Error("view " + photograph.Name, "the format neus has no subfolders", photograph.Name,
        fs::path(photograph.Name).filename().string());
    }
    ordered.push_back(&photograph);
  }
  // The readers number the photographs in their natural order.
  std::sort(ordered.begin(), ordered.end(),
    [](const Photograph* a, const Photograph* b) { return NaturallyBefore(a->Name, b->Name); });
  Arrays arrays;
  for (std::size_t i = 0; i < ordered.size(); ++i)
  {
    const Camera& camera = ordered[i]->Cam;
    Eigen::Matrix<double, 4, 4, Eigen::RowMajor> world = Eigen::Matrix4d::Identity();
    world.topLeftCorner<3, 3>() = camera.K * camera.R;
    world.topRightCorner<3, 1>() = camera.K * camera.T;
    arrays["world_mat_" + std::to_string(i)] = { { 4, 4 }, { world.data(), world.data() + 16 } };
    world.setIdentity();
    arrays["scale_mat_" + std::to_string(i)] = { { 4, 4 }, { world.data(), world.data() + 16 } };
  }
  return { { "cameras_sphere.npz", ComposeNpz(arrays) } };
}

/** What these formats have in common. */
DatasetFormat NumpyFormatOf(const std::string& name, const std::string& lookedFor)
{
  DatasetFormat format;
  format.Name = name;
  format.LookedFor = lookedFor;
  format.MaskFolder = "mask";
  format.MaskName = [](const std::string& photograph) { return photograph + ".png"; };
  format.HoldsLens = [](const Photograph& photograph) { return photograph.Distortion.IsPinhole(); };
  return format;
}

/** Those of some files that a folder has. */
std::vector<fs::path> FirstOf(const fs::path& folder, const std::vector<const char*>& names)
{
  std::error_code failure;
  for (const char* name : names)
  {
    const fs::path file = FileOfAnyCase(folder / name);
    if (fs::is_regular_file(file, failure))
    {
      return { file };
    }
  }
  return {};
}

bool IsNeusName(const fs::path& file)
{
  const std::string name = LowerCase(file.filename().string());
  return name.starts_with("cameras") && name.ends_with(".npz");
}
}

DatasetFormat NeusFormat()
{
  DatasetFormat format = NumpyFormatOf("neus", "cameras_sphere.npz");
  format.Find = [](const fs::path& folder) {
    return FirstOf(folder, { "cameras_sphere.npz", "cameras.npz", "cameras_large.npz" });
  };
  format.Accepts = IsNeusName;
  format.PhotoFolder = "image";
  format.Compose = ComposeNeus;
  format.Read = ReadNeus;
  return format;
}

DatasetFormat NumpyFormat()
{
  DatasetFormat format = NumpyFormatOf("numpy", "*.npz");
  format.Find = [](const fs::path& folder)
  {
    std::vector<fs::path> files;
    for (const fs::path& file : FilesIn(folder))
    {
      if (LowerCase(file.extension().string()) == ".npz" && !IsNeusName(file))
      {
        files.push_back(file);
      }
    }
    return files;
  };
  format.Accepts = [](const fs::path& file)
  { return LowerCase(file.extension().string()) == ".npz" && !IsNeusName(file); };
  format.Read = ReadNumpy;
  return format;
}

DatasetFormat LlffFormat()
{
  DatasetFormat format = NumpyFormatOf("llff", "poses_bounds.npy");
  format.Find = [](const fs::path& folder) { return FirstOf(folder, { "poses_bounds.npy" }); };
  format.Accepts = [](const fs::path& file)
  { return LowerCase(file.extension().string()) == ".npy"; };
  format.Read = ReadLlff;
  return format;
}
}
