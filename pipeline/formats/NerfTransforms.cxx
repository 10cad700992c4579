// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/NerfTransforms.h"

#include "base/JsonFile.h"
#include "base/NumberText.h"
#include "cameras/CameraLimits.h"
#include "cameras/PhotographFiles.h"
#include "core/Error.h"
#include "formats/WriteChecks.h"
#include "images/ImageFile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
using Json = nlohmann::ordered_json;

constexpr std::array PerspectiveKeys{ "k1", "k2", "p1", "p2", "k3" };
constexpr std::array FisheyeKeys{ "k1", "k2", "k3", "k4" };

CameraConvention NerfConvention()
{
  CameraConvention convention = ProjectConvention();
  convention.Axes = "opengl";
  convention.Poses = "camera-to-world";
  convention.PixelCentre = 0.5;
  return convention;
}

/** A frame and the whole file behind it; looks keys up in both. */
class Frame
{
public:
  Frame(const Json& own, const Json& shared, std::string where)
    : Where(std::move(where))
    , Values(own)
    , Shared(shared)
  {
  }

  /** The value of a key, null when there is none. */
  const Json* Find(const std::string& key) const
  {
    for (const Json* object : { &this->Values, &this->Shared })
    {
      const auto found = object->find(key);
      if (found != object->end() && !found->is_null())
      {
        return &*found;
      }
    }
    return nullptr;
  }

  /** A number; `otherwise` when there is none. */
  double Number(const std::string& key, double otherwise) const
  {
    const Json* value = this->Find(key);
    if (value && !value->is_number())
    {
      throw Error(
        this->Where, "key \"" + key + "\" is not a number", JsonTypeText(*value), "a number");
    }
    return value ? value->get<double>() : otherwise;
  }

  std::string Text(const std::string& key) const
  {
    const Json* value = this->Find(key);
    if (value && !value->is_string())
    {
      throw Error(this->Where, "key \"" + key + "\" is not a text", JsonTypeText(*value), "a text");
    }
    return value ? value->get<std::string>() : "";
  }

  std::string Where;

private:
  const Json& Values;
  const Json& Shared;
};

/**
 * The photograph's file, whose extension may be missing; the path as given if the file does not
 * exist.
 */
fs::path PhotoOf(const fs::path& folder, const std::string& filePath)
{
  std::error_code failure;
  fs::path said = (folder / filePath).lexically_normal();
  if (!fs::is_regular_file(said, failure))
  {
    for (const char* extension : { ".png", ".jpg", ".jpeg", ".PNG", ".JPG", ".JPEG" })
    {
      fs::path whole = said.string() + extension;
      if (fs::is_regular_file(whole, failure))
      {
        return whole;
      }
    }
  }
  return said;
}

void SetPose(const Frame& frame, Camera& camera)
{
  const Json* rows = frame.Find("transform_matrix");
  const bool shaped = rows && rows->is_array() && (rows->size() == 3 || rows->size() == 4) &&
    std::all_of(rows->begin(), rows->end(),
      [](const Json& row)
      {
        return row.is_array() && row.size() == 4 &&
          std::all_of(row.begin(), row.end(), [](const Json& value) { return value.is_number(); });
      });
  if (!shaped)
  {
    throw Error(frame.Where, "no pose", rows ? "something else" : "nothing",
      "\"transform_matrix\" of 4x4 or 3x4 numbers");
  }
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      camera.R(row, column) = (*rows)[row][column].get<double>();
    }
    camera.T[row] = (*rows)[row][3].get<double>();
  }
}

/** A focal length from its key, or from the field of view across `extent` pixels; else 0. */
double FocalLength(
  const Frame& frame, const std::string& key, const std::string& angleKey, double extent)
{
  const double angle = frame.Number(angleKey, 0);
  return frame.Number(key, angle > 0 ? extent / 2 / std::tan(angle / 2) : 0);
}

void SetIntrinsics(const Frame& frame, const fs::path& file, Camera& camera)
{
  camera.Width = ExtentOf(frame.Number("w", 0), "\"w\"", frame.Where);
  camera.Height = ExtentOf(frame.Number("h", 0), "\"h\"", frame.Where);
  if (camera.Width == 0 || camera.Height == 0)
  {
    std::error_code failure;
    const fs::path meant = fs::exists(file, failure)
      ? fs::path()
      : FileMeant(file.parent_path(), file.filename().string());
    const PictureSize size = ReadPictureSize(meant.empty() ? file : meant);
    camera.Width = size.Width;
    camera.Height = size.Height;
  }
  const double fx = FocalLength(frame, "fl_x", "camera_angle_x", camera.Width);
  const double fy = FocalLength(frame, "fl_y", "camera_angle_y", camera.Height);
  if (fx == 0 && fy == 0)
  {
    throw Error(frame.Where, "no focal length", "none", "fl_x or camera_angle_x");
  }
  camera.K << (fx == 0 ? fy : fx), 0, frame.Number("cx", camera.Width / 2.0), 0,
    (fy == 0 ? fx : fy), frame.Number("cy", camera.Height / 2.0), 0, 0, 1;
}

bool IsFisheye(const Frame& frame)
{
  constexpr std::array Perspective{ "", "PINHOLE", "SIMPLE_PINHOLE", "SIMPLE_RADIAL", "RADIAL",
    "OPENCV", "PERSPECTIVE" };
  const std::string model = frame.Text("camera_model");
  if (model == "OPENCV_FISHEYE")
  {
    return true;
  }
  if (std::find(Perspective.begin(), Perspective.end(), model) == Perspective.end())
  {
    throw Error(frame.Where, "camera model cannot be undistorted", model,
      "PINHOLE, SIMPLE_PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV or OPENCV_FISHEYE");
  }
  const Json* flag = frame.Find("is_fisheye");
  return flag && flag->is_boolean() && flag->get<bool>();
}

Lens LensOf(const Frame& frame)
{
  Lens lens;
  if (IsFisheye(frame))
  {
    lens.Kind = Lens::Model::Fisheye;
    for (const char* key : FisheyeKeys)
    {
      lens.Coefficients.push_back(frame.Number(key, 0));
    }
    return lens;
  }
  for (const char* key : PerspectiveKeys)
  {
    lens.Coefficients.push_back(frame.Number(key, 0));
  }
  if (frame.Number("k4", 0) != 0)
  {
    throw Error(frame.Where, "a perspective lens with k4 cannot be undistorted",
      NumberText(frame.Number("k4", 0)), "k1, k2, p1, p2, k3");
  }
  return Trimmed(lens);
}

Photograph PhotographOf(const Frame& frame, const fs::path& folder)
{
  const std::string filePath = frame.Text("file_path");
  if (filePath.empty())
  {
    throw Error(frame.Where, "has no \"file_path\"");
  }
  Photograph photograph;
  photograph.File = PhotoOf(folder, filePath);
  const fs::path inFolder = photograph.File.lexically_relative(folder.lexically_normal());
  photograph.Name = NameOfFile(inFolder.empty() ? photograph.File.filename() : inFolder);
  photograph.Where = frame.Where + " (" + photograph.Name + ")";
  if (const std::string mask = frame.Text("mask_path"); !mask.empty())
  {
    photograph.Mask = (folder / mask).lexically_normal();
  }
  SetPose(frame, photograph.Cam);
  SetIntrinsics(frame, photograph.File, photograph.Cam);
  photograph.Distortion = LensOf(frame);
  return photograph;
}

/** Says what the other files of a split are for, next to the one that is read. */
void NoteSplit(const fs::path& path, Calibration& calibration)
{
  const std::string name = LowerCase(path.filename().string());
  if (name != "transforms.json" && name != "transforms_train.json")
  {
    return;
  }
  const fs::path held = NerfTestSplit(path);
  std::string text = held.empty()
    ? ""
    : held.filename().string() + " holds no references: evaluate predicts its views";
  std::error_code failure;
  for (const char* other : { "transforms_train.json", "transforms_val.json" })
  {
    const fs::path file = FileOfAnyCase(path.parent_path() / other);
    if (LowerCase(file.filename().string()) != name && file != held &&
      fs::is_regular_file(file, failure))
    {
      text += (text.empty() ? "" : "; ") + file.filename().string() + " is not used";
    }
  }
  if (!text.empty())
  {
    calibration.Notes.push_back({ "split", text + " (--calibration reads another file)", false });
  }
}

Calibration ReadNerf(const fs::path&, const fs::path& path)
{
  const Json whole = ReadJsonFile(path);
  const auto frames = whole.is_object() ? whole.find("frames") : whole.end();
  if (!whole.is_object() || frames == whole.end() || !frames->is_array())
  {
    throw Error(path.string(), "has no \"frames\"");
  }
  Calibration calibration;
  calibration.Convention = NerfConvention();
  for (std::size_t i = 0; i < frames->size(); ++i)
  {
    const std::string where = path.string() + ", frame " + std::to_string(i);
    if (!(*frames)[i].is_object())
    {
      throw Error(where, "is not an object");
    }
    // Paths in the file start from its own folder.
    calibration.Photographs.push_back(
      PhotographOf(Frame((*frames)[i], whole, where), path.parent_path()));
  }
  NoteSplit(path, calibration);
  return calibration;
}

Json IntrinsicsJson(const Photograph& photograph, const Camera& stated)
{
  const Lens lens = Trimmed(photograph.Distortion);
  const bool isFisheye = lens.Kind == Lens::Model::Fisheye;
  Json object;
  object["camera_model"] = isFisheye ? "OPENCV_FISHEYE" : (lens.IsPinhole() ? "PINHOLE" : "OPENCV");
  if (isFisheye)
  {
    object["is_fisheye"] = true;
  }
  object["fl_x"] = stated.K(0, 0);
  object["fl_y"] = stated.K(1, 1);
  object["cx"] = stated.K(0, 2);
  object["cy"] = stated.K(1, 2);
  object["w"] = stated.Width;
  object["h"] = stated.Height;
  if (!lens.IsPinhole())
  {
    for (std::size_t i = 0; i < lens.Coefficients.size(); ++i)
    {
      object[isFisheye ? FisheyeKeys[i] : PerspectiveKeys[i]] = lens.Coefficients[i];
    }
  }
  return object;
}

Json MatrixJson(const Camera& stated)
{
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row)
  {
    rows.push_back({ stated.R(row, 0), stated.R(row, 1), stated.R(row, 2), stated.T[row] });
  }
  rows.push_back({ 0.0, 0.0, 0.0, 1.0 });
  return rows;
}

std::vector<FileContent> ComposeNerf(const std::string&, const std::vector<Photograph>& photographs)
{
  std::vector<Json> intrinsics;
  Json frames = Json::array();
  for (const Photograph& photograph : photographs)
  {
    RefuseSkew(photograph, "nerf");
    RequireUtf8Name(photograph, "nerf");
    const Camera stated = InConvention(NerfConvention(), photograph.Cam);
    intrinsics.push_back(IntrinsicsJson(photograph, stated));
    Json frame;
    frame["file_path"] = (fs::path("images") / photograph.Name).string();
    if (!photograph.Mask.empty())
    {
      frame["mask_path"] = photograph.Mask.string();
    }
    frame["transform_matrix"] = MatrixJson(stated);
    frames.push_back(frame);
  }
  Json whole = Json::object();
  const bool shared = std::all_of(intrinsics.begin(), intrinsics.end(),
    [&intrinsics](const Json& each) { return each == intrinsics.front(); });
  if (shared)
  {
    whole = intrinsics.front();
  }
  else
  {
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
      frames[i].update(intrinsics[i]);
    }
  }
  whole["frames"] = frames;
  return { { "transforms.json", DumpJson(whole) + "\n" } };
}
}

fs::path NerfTestSplit(const fs::path& calibration)
{
  std::error_code failure;
  for (const char* name : { "transforms_test.json", "transforms_val.json" })
  {
    const fs::path file = FileOfAnyCase(calibration.parent_path() / name);
    if (fs::is_regular_file(file, failure))
    {
      return file;
    }
  }
  return {};
}

DatasetFormat NerfFormat()
{
  DatasetFormat format;
  format.Name = "nerf";
  format.LookedFor = "transforms.json";
  format.Find = [](const fs::path& folder)
  {
    std::error_code failure;
    for (const char* name : { "transforms.json", "transforms_train.json" })
    {
      const fs::path file = FileOfAnyCase(folder / name);
      if (fs::is_regular_file(file, failure))
      {
        return std::vector{ file };
      }
    }
    return std::vector<fs::path>();
  };
  format.Accepts = [](const fs::path& path)
  { return LowerCase(path.extension().string()) == ".json"; };
  format.Read = ReadNerf;
  format.PhotoFolder = "images";
  format.MaskFolder = "masks";
  format.MaskName = [](const std::string& name) { return name + ".png"; };
  format.HoldsLens = [](const Photograph& photograph)
  {
    const bool fisheye = photograph.Distortion.Kind == Lens::Model::Fisheye;
    return Trimmed(photograph.Distortion).Coefficients.size() <=
      (fisheye ? FisheyeKeys.size() : PerspectiveKeys.size());
  };
  format.Compose = ComposeNerf;
  return format;
}
}
