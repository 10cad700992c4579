// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/OpenCvCalibration.h"

#include "base/InputFile.h"
#include "base/NumberText.h"
#include "cameras/CameraLimits.h"
#include "cameras/PhotographFiles.h"
#include "core/Error.h"
#include "formats/OpenCvStorage.h"
#include "formats/WriteChecks.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/** A value of a map by its key; None when there is none. Samples differ in capitals. */
const StorageNode& NodeOf(const StorageNode& map, const std::string& key)
{
  if (const StorageNode& node = map[key]; !node.IsNone())
  {
    return node;
  }
  std::string capital = key;
  bool first = true;
  for (char& c : capital)
  {
    c = first ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    first = c == '_';
  }
  return map[capital];
}

/** The values of a view, followed by those of the whole file for all views. */
struct ViewNodes
{
  const StorageNode& View;
  const StorageNode& Shared;
  std::string Where;

  const StorageNode& Find(const std::string& key) const
  {
    const StorageNode& own = NodeOf(this->View, key);
    return own.IsNone() ? NodeOf(this->Shared, key) : own;
  }

  /** The numbers of a matrix or of a list, row by row; none when the key is missing. */
  std::vector<double> Numbers(const std::string& key) const
  {
    return this->Find(key).Numbers(this->Where + ", \"" + key + "\"");
  }

  std::vector<double> Needed(const std::string& key, std::size_t count) const
  {
    std::vector<double> numbers = this->Numbers(key);
    if (numbers.size() != count)
    {
      throw Error(this->Where, "wrong length of \"" + key + "\"",
        numbers.empty() ? "none" : std::to_string(numbers.size()) + " numbers",
        std::to_string(count));
    }
    return numbers;
  }

  /** A number; 0 when the key is missing. */
  double Number(const std::string& key) const
  {
    const StorageNode& node = this->Find(key);
    if (!node.IsNone() && node.What != StorageNode::Kind::Number)
    {
      throw Error(this->Where, "\"" + key + "\" is not a number",
        node.IsText() ? "'" + node.Text + "'" : "a list or map", "a number");
    }
    return std::rint(node.Number);
  }
};

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Matrix3d RotationOf(const double* rvec)
{
  cv::Matx33d rotation;
  cv::Rodrigues(cv::Vec3d(rvec), rotation);
  return Eigen::Map<const RowMajor3>(rotation.val);
}

Lens LensOf(const ViewNodes& nodes)
{
  Lens lens;
  const StorageNode& model = nodes.Find("distortion_model");
  const std::string name = model.IsText() ? model.Text : "";
  if (name == "fisheye" || (name.empty() && nodes.Number("fisheye_model") == 1))
  {
    lens.Kind = Lens::Model::Fisheye;
  }
  else if (!name.empty() && name != "perspective" && name != "plumb_bob" &&
    name != "rational_polynomial")
  {
    throw Error(nodes.Where, "unknown distortion model", name,
      "perspective, plumb_bob, rational_polynomial or fisheye");
  }
  lens.Coefficients = nodes.Numbers("distortion_coefficients");
  return lens;
}

/** Everything but name, file and pose. */
Photograph IntrinsicsOf(const ViewNodes& nodes)
{
  Photograph photograph;
  photograph.Where = nodes.Where;
  photograph.Cam.K = Eigen::Map<const RowMajor3>(nodes.Needed("camera_matrix", 9).data());
  photograph.Cam.Width = ExtentOf(nodes.Number("image_width"), "\"image_width\"", nodes.Where);
  photograph.Cam.Height = ExtentOf(nodes.Number("image_height"), "\"image_height\"", nodes.Where);
  photograph.Distortion = LensOf(nodes);
  return photograph;
}

std::vector<Photograph> ReadViews(const StorageNode& root, const fs::path& file)
{
  std::vector<Photograph> photographs;
  for (const StorageNode& view : root["views"].Items)
  {
    const std::string place = file.string() + ", view " + std::to_string(photographs.size());
    const StorageNode& image = view["image"];
    if (!image.IsText())
    {
      throw Error(place, "has no \"image\"");
    }
    const std::string& path = image.Text;
    const ViewNodes nodes{ view, root, place + " (" + path + ")" };
    Photograph photograph = IntrinsicsOf(nodes);
    photograph.Name = NameOfFile(path);
    photograph.File = file.parent_path() / path;
    if (const StorageNode& mask = view["mask"]; mask.IsText())
    {
      photograph.Mask = file.parent_path() / mask.Text;
    }
    photograph.Cam.R = view["R"].IsNone()
      ? RotationOf(nodes.Needed("rvec", 3).data())
      : Eigen::Matrix3d(Eigen::Map<const RowMajor3>(nodes.Needed("R", 9).data()));
    photograph.Cam.T = Eigen::Map<const Eigen::Vector3d>(nodes.Needed("tvec", 3).data());
    photographs.push_back(photograph);
  }
  return photographs;
}

/** The photographs' files of a calibration sample: a list of texts, or texts with blanks between. */
std::vector<fs::path> ListedImages(
  const StorageNode& root, const fs::path& folder, const std::string& where)
{
  std::vector<fs::path> files;
  const StorageNode& images = root["images"];
  for (const std::string& word : Words(images.IsText() ? images.Text : ""))
  {
    files.push_back(folder / word);
  }
  for (const StorageNode& image : images.Items)
  {
    if (!image.IsText())
    {
      throw Error(where, "\"images\" contains something other than file names",
        image.Text.empty() ? "a list or map" : image.Text, "names in quotes");
    }
    files.push_back(folder / image.Text);
  }
  if (files.empty())
  {
    for (const std::string& name : PhotographsIn(folder))
    {
      files.push_back(folder / name);
    }
  }
  return files;
}

std::vector<Photograph> ReadSample(const StorageNode& root, const fs::path& file)
{
  const ViewNodes nodes{ root, root, file.string() };
  const std::vector<double> poses = nodes.Numbers("extrinsic_parameters");
  if (poses.empty() || poses.size() % 6 != 0)
  {
    throw Error(file.string(), "no poses", "neither",
      "\"views\", or \"extrinsic_parameters\" with rows of 6 numbers");
  }
  const std::vector<fs::path> files = ListedImages(root, file.parent_path(), file.string());
  const std::size_t count = poses.size() / 6;
  if (files.size() != count)
  {
    throw Error(file.string(), "not as many photographs as poses", std::to_string(files.size()),
      std::to_string(count) + ", in \"images\" or in the folder");
  }
  std::vector<Photograph> photographs;
  for (std::size_t i = 0; i < count; ++i)
  {
    Photograph photograph = IntrinsicsOf(nodes);
    photograph.File = files[i];
    photograph.Name = NameOfFile(files[i].lexically_relative(file.parent_path()));
    photograph.Where = file.string() + ", pose " + std::to_string(i) + " (" + photograph.Name + ")";
    photograph.Cam.R = RotationOf(&poses[6 * i]);
    photograph.Cam.T = Eigen::Map<const Eigen::Vector3d>(&poses[6 * i + 3]);
    photographs.push_back(photograph);
  }
  return photographs;
}

Calibration ReadOpenCv(const fs::path&, const fs::path& file)
{
  const StorageNode root = ReadOpenCvStorage(file);
  return { ProjectConvention(),
    root["views"].IsList() ? ReadViews(root, file) : ReadSample(root, file) };
}

/** Whether a file of the folder, which may be anything, can be read and is a calibration. */
bool HoldsCameraMatrix(const fs::path& path)
{
  try
  {
    const std::string text = ReadInputStart(path, MaxStorageBytes);
    return text.find("camera_matrix") != std::string::npos ||
      text.find("Camera_Matrix") != std::string::npos;
  }
  catch (const Error&)
  {
    return false;
  }
}

bool IsStorage(const fs::path& path)
{
  const std::string extension = LowerCase(path.extension().string());
  return extension == ".yml" || extension == ".yaml" || extension == ".xml";
}

std::vector<fs::path> FindOpenCv(const fs::path& folder)
{
  std::vector<fs::path> files = FilesIn(folder);
  std::erase_if(
    files, [](const fs::path& file) { return !IsStorage(file) || !HoldsCameraMatrix(file); });
  return files;
}

/** The coefficients with zeros at the end, as many as OpenCV's functions take. */
cv::Mat CoefficientsOf(const Lens& lens)
{
  std::vector<double> numbers = lens.Coefficients;
  for (const std::size_t count : { 14, 12, 8, 5, 4 })
  {
    if (lens.Coefficients.size() <= count)
    {
      numbers.resize(count, 0);
    }
  }
  return cv::Mat(numbers, true);
}

cv::Mat MatOf(const Eigen::Matrix3d& matrix)
{
  RowMajor3 rows = matrix;
  return cv::Mat(3, 3, CV_64F, rows.data()).clone();
}

std::vector<FileContent> ComposeOpenCv(
  const std::string&, const std::vector<Photograph>& photographs)
{
  cv::FileStorage storage("cameras.yml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  storage << "views"
          << "[";
  for (const Photograph& photograph : photographs)
  {
    const Camera& camera = photograph.Cam;
    const Lens& lens = photograph.Distortion;
    RequireAsciiName(photograph, "opencv");
    storage << "{"
            << "image" << photograph.Name;
    if (!photograph.Mask.empty())
    {
      storage << "mask" << photograph.Mask.string();
    }
    storage << "image_width" << camera.Width << "image_height" << camera.Height << "camera_matrix"
            << MatOf(camera.K);
    if (!lens.IsPinhole())
    {
      const bool isFisheye = lens.Kind == Lens::Model::Fisheye;
      storage << "distortion_model" << (isFisheye ? "fisheye" : "perspective")
              << "distortion_coefficients" << CoefficientsOf(lens);
    }
    storage << "R" << MatOf(camera.R) << "tvec"
            << cv::Mat(cv::Vec3d(camera.T.x(), camera.T.y(), camera.T.z())) << "}";
  }
  storage << "]";
  return { { "cameras.yml", storage.releaseAndGetString() } };
}
}

DatasetFormat OpenCvFormat()
{
  DatasetFormat format;
  format.Name = "opencv";
  format.LookedFor = "*.yml, *.yaml or *.xml";
  format.Find = FindOpenCv;
  format.Accepts = IsStorage;
  format.Read = ReadOpenCv;
  format.MaskFolder = "masks";
  format.MaskName = [](const std::string& name) { return name + ".png"; };
  format.HoldsLens = [](const Photograph&) { return true; };
  format.Compose = ComposeOpenCv;
  return format;
}
}
