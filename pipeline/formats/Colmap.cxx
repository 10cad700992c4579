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
  const auto exists = [&](const char* stem)
  { return fs::is_regular_file(FileOfAnyCase(folder / (std::string(stem) + extension)), failure); };
  return exists("cameras") && exists("images");
}

/** The folders in which COLMAP leaves models: the data set's, sparse/ and those numbered in there. */
std::vector<fs::path> ModelPlaces(const fs::path& folder)
{
  std::vector<fs::path> places{ folder, folder / "sparse" };
  std::vector<std::string> numbers;
  std::error_code failure;
  for (fs::directory_iterator entry(folder / "sparse", failure), end; !failure && entry != end;
       entry.increment(failure))
  {
    numbers.push_back(entry->path().filename().string());
  }
  std::sort(numbers.begin(), numbers.end(), NaturallyBefore);
  for (const std::string& number : numbers)
  {
    places.push_back(folder / "sparse" / number);
  }
  return places;
}

/** How many images a model has, as its file says it; 0 when it cannot be read. */
std::size_t ImageCount(const fs::path& imagesFile)
{
  try
  {
    const fs::path place = imagesFile.parent_path();
    return (imagesFile.extension() == ".bin" ? ReadColmapBinary(place) : ReadColmapText(place))
      .Images.size();
  }
  catch (const Error&)
  {
    return 0; // who reads it says why
  }
}

/** The images files of all models of these encodings, one per folder. */
std::vector<fs::path> AllModels(const fs::path& folder, const std::vector<const char*>& extensions)
{
  std::vector<fs::path> models;
  for (const fs::path& place : ModelPlaces(folder))
  {
    for (const char* extension : extensions)
    {
      if (HasModel(place, extension))
      {
        models.push_back(FileOfAnyCase(place / (std::string("images") + extension)));
        break;
      }
    }
  }
  return models;
}

/** The images file of the model with most images; of equals, the first. */
std::vector<fs::path> FindModel(const fs::path& folder, const std::vector<const char*>& extensions)
{
  const std::vector<fs::path> models = AllModels(folder, extensions);
  if (models.size() < 2)
  {
    return models;
  }
  const fs::path* best = nullptr;
  std::size_t most = 0;
  for (const fs::path& model : models)
  {
    const std::size_t count = ImageCount(model);
    if (!best || count > most)
    {
      best = &model;
      most = count;
    }
  }
  return { *best };
}

/** Says which of several models is read. */
void NoteOtherModels(
  const fs::path& folder, const fs::path& place, std::size_t images, Calibration& calibration)
{
  std::vector<std::string> others;
  for (const fs::path& model : AllModels(folder, { ".bin", ".txt" }))
  {
    std::error_code failure;
    if (!fs::equivalent(model.parent_path(), place, failure))
    {
      others.push_back(model.parent_path().lexically_relative(folder).string() + " (" +
        std::to_string(ImageCount(model)) + " images)");
    }
  }
  if (!others.empty())
  {
    calibration.Notes.push_back({ "several-models",
      "several COLMAP models: read " + place.lexically_relative(folder).string() + " (" +
        std::to_string(images) + " images), not " + Joined(others) + "; --calibration chooses",
      false });
  }
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
  NoteOtherModels(folder, place, images.size(), result);
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
  format.LookedFor = "sparse/0/";
  format.Find = [](const fs::path& folder) { return FindModel(folder, { ".bin", ".txt" }); };
  format.Accepts = [](const fs::path& path)
  {
    std::error_code failure;
    const std::string name = LowerCase(path.filename().string());
    // MVSNet's folder of cameras is a folder, too.
    return (fs::is_directory(path, failure) && name != "cams") || name == "cameras.txt" ||
      name == "images.txt" || name == "cameras.bin" || name == "images.bin";
  };
  format.Compose = [](const std::string&, const std::vector<Photograph>& photographs)
  { return InSparse(ComposeColmapText(ModelOf(photographs))); };
  return format;
}

DatasetFormat ColmapBinaryFormat()
{
  DatasetFormat format = ColmapFormat();
  format.Name = "colmap-binary";
  format.LookedFor = "cameras.bin and images.bin in sparse/0/";
  format.Find = [](const fs::path& folder) { return FindModel(folder, { ".bin" }); };
  format.Accepts = [](const fs::path&) { return false; }; // "colmap" accepts it
  format.Compose = [](const std::string&, const std::vector<Photograph>& photographs)
  { return InSparse(ComposeColmapBinary(ModelOf(photographs))); };
  return format;
}
}
