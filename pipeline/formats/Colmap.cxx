// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/Colmap.h"

#include "base/NumberText.h"
#include "cameras/PhotographFiles.h"
#include "core/Error.h"
#include "formats/ColmapBinary.h"
#include "formats/ColmapModel.h"
#include "formats/ColmapText.h"
#include "formats/WriteChecks.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <map>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/** K (pixel centres at 0.5), size and lens of a camera. */
Photograph IntrinsicsOf(const ColmapCamera& camera)
{
  const ColmapModelInfo* info = ColmapInfoOf(camera.Model);
  if (!info || info->FocalLengths == 0)
  {
    throw Error(
      camera.Where, "camera model cannot be undistorted", camera.Model, ReadableColmapModels());
  }
  const std::vector<double>& p = camera.Parameters;
  if (static_cast<int>(p.size()) != info->Parameters)
  {
    throw Error(camera.Where, "wrong number of parameters for " + camera.Model,
      std::to_string(p.size()), std::to_string(info->Parameters));
  }
  const std::size_t centre = static_cast<std::size_t>(info->FocalLengths);
  Photograph result;
  result.Cam.K << p[0], 0, p[centre], 0, p[centre - 1], p[centre + 1], 0, 0, 1;
  result.Cam.Width = camera.Width;
  result.Cam.Height = camera.Height;
  result.Distortion = { info->Kind,
    { p.begin() + static_cast<std::ptrdiff_t>(centre) + 2, p.end() } };
  return result;
}

void SetPose(const ColmapImage& image, Camera& camera)
{
  const auto& q = image.Rotation;
  const Eigen::Quaterniond rotation(q[0], q[1], q[2], q[3]);
  // Files written with few digits are a little off; anything else is no rotation.
  if (!(std::abs(rotation.norm() - 1) < 1e-2))
  {
    throw Error(image.Where, "quaternion is not of length 1", NumberText(rotation.norm()), "1");
  }
  camera.R = rotation.normalized().toRotationMatrix();
  camera.T = Eigen::Map<const Eigen::Vector3d>(image.Translation.data());
}

/** Whether a folder has cameras and images with this extension. */
bool HasModel(const fs::path& folder, const char* extension)
{
  std::error_code failure;
  return fs::is_regular_file(folder / (std::string("cameras") + extension), failure) &&
    fs::is_regular_file(folder / (std::string("images") + extension), failure);
}

/** The images file of the first model of these encodings. */
std::vector<fs::path> FindModel(const fs::path& folder, const std::vector<const char*>& extensions)
{
  for (const fs::path& place : { folder, folder / "sparse", folder / "sparse" / "0" })
  {
    for (const char* extension : extensions)
    {
      if (HasModel(place, extension))
      {
        return { place / (std::string("images") + extension) };
      }
    }
  }
  return {};
}

Calibration ReadColmap(const fs::path& folder, const fs::path& calibration)
{
  std::error_code failure;
  const bool isFolder = fs::is_directory(calibration, failure);
  const fs::path place = isFolder ? calibration : calibration.parent_path();
  const bool isBinary = isFolder ? HasModel(place, ".bin") : calibration.extension() == ".bin";
  const ColmapModel model = isBinary ? ReadColmapBinary(place) : ReadColmapText(place);
  std::map<std::uint32_t, const ColmapCamera*> cameras;
  for (const ColmapCamera& camera : model.Cameras)
  {
    if (!cameras.emplace(camera.Id, &camera).second)
    {
      throw Error(camera.Where, "camera " + std::to_string(camera.Id) + " is there twice");
    }
  }
  std::vector<ColmapImage> images = model.Images;
  std::stable_sort(images.begin(), images.end(),
    [](const ColmapImage& a, const ColmapImage& b) { return a.Id < b.Id; });
  Calibration result;
  result.Convention = ProjectConvention();
  result.Convention.PixelCentre = 0.5;
  for (const ColmapImage& image : images)
  {
    const auto camera = cameras.find(image.CameraId);
    if (camera == cameras.end())
    {
      throw Error(image.Where, "image " + image.Name + " has no camera",
        "camera " + std::to_string(image.CameraId), "one of the cameras file");
    }
    Photograph photograph = IntrinsicsOf(*camera->second);
    SetPose(image, photograph.Cam);
    photograph.Name = image.Name;
    photograph.File = FileIn({ folder / "images", folder }, image.Name);
    photograph.Where = image.Where + " (" + image.Name + ")";
    result.Photographs.push_back(photograph);
  }
  return result;
}

/** The camera of a photograph with the model that just holds its lens. */
ColmapCamera CameraOf(const Photograph& photograph, const Camera& stated)
{
  const auto& K = stated.K;
  const Lens lens = Trimmed(photograph.Distortion);
  ColmapCamera camera;
  camera.Width = stated.Width;
  camera.Height = stated.Height;
  camera.Parameters = { K(0, 0), K(1, 1), K(0, 2), K(1, 2) };
  if (lens.Kind == Lens::Model::Fisheye)
  {
    camera.Model = "OPENCV_FISHEYE";
  }
  else
  {
    camera.Model =
      lens.IsPinhole() ? "PINHOLE" : (lens.Coefficients.size() <= 4 ? "OPENCV" : "FULL_OPENCV");
  }
  camera.Parameters.insert(
    camera.Parameters.end(), lens.Coefficients.begin(), lens.Coefficients.end());
  camera.Parameters.resize(static_cast<std::size_t>(ColmapInfoOf(camera.Model)->Parameters), 0);
  return camera;
}

ColmapModel ModelOf(const std::vector<Photograph>& photographs)
{
  CameraConvention convention = ProjectConvention();
  convention.PixelCentre = 0.5;
  ColmapModel model;
  for (const Photograph& photograph : photographs)
  {
    RefuseSkew(photograph, "colmap");
    ColmapCamera camera = CameraOf(photograph, InConvention(convention, photograph.Cam));
    const auto same = std::find_if(model.Cameras.begin(), model.Cameras.end(),
      [&camera](const ColmapCamera& other)
      {
        return other.Model == camera.Model && other.Width == camera.Width &&
          other.Height == camera.Height && other.Parameters == camera.Parameters;
      });
    camera.Id = static_cast<std::uint32_t>(same - model.Cameras.begin()) + 1;
    if (same == model.Cameras.end())
    {
      model.Cameras.push_back(camera);
    }
    const Eigen::Quaterniond q(NearestRotation(photograph.Cam.R));
    ColmapImage image;
    image.Id = static_cast<std::uint32_t>(model.Images.size()) + 1;
    image.Rotation = { q.w(), q.x(), q.y(), q.z() };
    const Eigen::Vector3d& t = photograph.Cam.T;
    image.Translation = { t.x(), t.y(), t.z() };
    image.CameraId = camera.Id;
    image.Name = photograph.Name;
    model.Images.push_back(image);
  }
  return model;
}

/** A model's files where COLMAP writes the first one. */
std::vector<FileContent> InSparse(std::vector<FileContent> files)
{
  for (FileContent& file : files)
  {
    file.Path = fs::path("sparse") / "0" / file.Path;
  }
  return files;
}

DatasetFormat ColmapFormat()
{
  DatasetFormat format;
  format.Read = ReadColmap;
  format.PhotoFolder = "images";
  format.MaskFolder = "masks";
  format.MaskName = [](const std::string& name) { return name + ".png"; };
  format.HoldsLens = [](const Photograph& photograph)
  { return Trimmed(photograph.Distortion).Coefficients.size() <= 8; };
  return format;
}
}

DatasetFormat ColmapTextFormat()
{
  DatasetFormat format = ColmapFormat();
  format.Name = "colmap";
  format.LookedFor = "cameras and images .bin or .txt, also in sparse/0/";
  format.Find = [](const fs::path& folder) { return FindModel(folder, { ".bin", ".txt" }); };
  format.Accepts = [](const fs::path& path)
  {
    std::error_code failure;
    const std::string name = path.filename().string();
    return fs::is_directory(path, failure) || name == "cameras.txt" || name == "images.txt" ||
      name == "cameras.bin" || name == "images.bin";
  };
  format.Compose = [](const std::string&, const std::vector<Photograph>& photographs)
  { return InSparse(ComposeColmapText(ModelOf(photographs))); };
  return format;
}

DatasetFormat ColmapBinaryFormat()
{
  DatasetFormat format = ColmapFormat();
  format.Name = "colmap-binary";
  format.LookedFor = "cameras.bin and images.bin, also in sparse/0/";
  format.Find = [](const fs::path& folder) { return FindModel(folder, { ".bin" }); };
  format.Accepts = [](const fs::path&) { return false; }; // "colmap" accepts it
  format.Compose = [](const std::string&, const std::vector<Photograph>& photographs)
  { return InSparse(ComposeColmapBinary(ModelOf(photographs))); };
  return format;
}
}
