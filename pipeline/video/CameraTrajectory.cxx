// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/CameraTrajectory.h"

#include "base/JsonFile.h"
#include "base/NumberText.h"
#include "cameras/CameraGrid.h"
#include "core/ToInt.h"
#include "dataset/PhotographSize.h"
#include "dataset/ViewSpec.h"
#include "geometry/CameraPath.h"
#include "options/NearestWord.h"
#include "options/Options.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
using Json = nlohmann::ordered_json;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int UsualFrames = 72;

/** A photograph's camera with its image's size. */
Camera CameraOf(const std::string& nameOrNumber, const DatasetIndex& dataset)
{
  ViewSpec spec;
  spec.What = ViewSpec::Kind::Like;
  spec.Name = nameOrNumber;
  return ResolveViewSpec(spec, dataset).Cam;
}

/** The numbers of an array, also of an array of arrays; this many are expected. */
std::vector<double> Numbers(const Json& value, std::size_t count, const std::string& where)
{
  std::vector<double> numbers;
  const auto add = [&](const Json& each, const auto& self) -> void
  {
    if (each.is_array())
    {
      for (const Json& part : each)
      {
        self(part, self);
      }
    }
    else if (each.is_number())
    {
      numbers.push_back(each.get<double>());
    }
    else
    {
      throw UsageError(where, "has the wrong type", each.type_name(), "numbers");
    }
  };
  add(value, add);
  if (!value.is_array() || numbers.size() != count)
  {
    throw UsageError(
      where, "has the wrong length", std::to_string(numbers.size()), std::to_string(count));
  }
  return numbers;
}

Vector3d VectorOf(const Json& value, const std::string& where)
{
  return Vector3d(Numbers(value, 3, where).data());
}

Matrix3d MatrixOf(const Json& value, const std::string& where)
{
  const std::vector<double> numbers = Numbers(value, 9, where);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers.data());
}

double NumberOf(const Json& value, const std::string& where)
{
  if (!value.is_number())
  {
    throw UsageError(where, "has the wrong type", value.type_name(), "a number");
  }
  return value.get<double>();
}

/** Refuses keys that mean nothing. */
void CheckKeys(const Json& object, const std::vector<std::string>& known, const std::string& where)
{
  for (const auto& [key, value] : object.items())
  {
    if (std::find(known.begin(), known.end(), key) == known.end())
    {
      const std::string nearest = NearestWord(key, known);
      throw UsageError(where,
        "unknown key \"" + key + "\"" +
          (nearest.empty() ? "" : ", did you mean \"" + nearest + "\"?"));
    }
  }
}

/** Reads the key cameras of a path file. */
class PathReader
{
public:
  PathReader(const TrajectoryOptions& options, const DatasetIndex& dataset)
    : Options(options)
    , Dataset(dataset)
    , First(SizedCamera(dataset.Cameras.front()))
    , Usual(this->First)
    , File(options.Path.string())
    , Whole(ReadJsonObject(options.Path))
  {
    CheckKeys(this->Whole, { "keys", "closed", "size" }, this->File);
    const Json keys = this->Whole.value("keys", Json());
    if (!keys.is_array() || keys.size() < 2)
    {
      throw UsageError(this->File, "has no key cameras", keys.is_array() ? "too few" : "no array",
        "\"keys\", an array of at least 2");
    }
    if (this->Whole.contains("size"))
    {
      this->SetSize();
    }
    this->Up.setZero();
    for (const Photograph& photograph : dataset.Cameras)
    {
      this->Up -= photograph.Cam.R.row(1);
    }
  }

  std::vector<Camera> Cameras()
  {
    std::vector<KeyCamera> keys;
    const Json& all = this->Whole["keys"];
    const char* const clock = this->ClockOf(all);
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      const std::string where = this->File + ", key camera " + std::to_string(i);
      KeyCamera key;
      key.Cam = this->ReadKey(all[i], where);
      ValidateCamera(key.Cam, where);
      key.Time = clock ? NumberOf(all[i][clock], where) : static_cast<double>(i);
      keys.push_back(key);
    }
    const bool closed = this->Closed();
    const CameraPath path(keys, closed);
    const int count = this->CountOf(path, clock);
    // A closed path ends where it began, and that frame is there already.
    const int steps = std::max(closed ? count : count - 1, 1);
    std::vector<Camera> cameras;
    for (int frame = 0; frame < count; ++frame)
    {
      const double part = static_cast<double>(frame) / steps;
      cameras.push_back(path.At(path.Begin() + part * (path.End() - path.Begin())));
    }
    return cameras;
  }

private:
  void SetSize()
  {
    const Json& size = this->Whole["size"];
    const std::string where = this->File + ", key \"size\"";
    if (!size.is_string())
    {
      throw UsageError(where, "has the wrong type", size.type_name(), "a text like \"640x480\"");
    }
    Option option{ "size", "", "", "", SizeTarget{ &this->Usual.Width, &this->Usual.Height }, 16,
      16384 };
    SetFromText(option, { size.get<std::string>() });
  }

  bool Closed() const
  {
    const Json closed = this->Whole.value("closed", Json(false));
    if (!closed.is_boolean())
    {
      throw UsageError(
        this->File + ", key \"closed\"", "has the wrong type", closed.type_name(), "true or false");
    }
    return closed.get<bool>();
  }

  /** "frame", "time" or, when no key has either, null. */
  const char* ClockOf(const Json& keys) const
  {
    for (const char* clock : { "frame", "time" })
    {
      const auto having = std::count_if(
        keys.begin(), keys.end(), [clock](const Json& key) { return key.contains(clock); });
      if (having > 0)
      {
        if (having != static_cast<long>(keys.size()))
        {
          throw UsageError(this->File, std::string("some key cameras have no \"") + clock + "\"",
            std::to_string(having) + " of " + std::to_string(keys.size()), "all or none");
        }
        return clock;
      }
    }
    return nullptr;
  }

  int CountOf(const CameraPath& path, const char* clock) const
  {
    if (this->Options.Frames > 0 || !clock)
    {
      return this->Options.Frames > 0 ? this->Options.Frames : UsualFrames;
    }
    const double perFrame = std::string(clock) == "frame" ? 1 : this->Options.Fps;
    const double steps = (path.End() - path.Begin()) * perFrame;
    if (!(steps < 1e6))
    {
      throw UsageError(this->File, "is too long", NumberText(steps), "at most 1000000 frames");
    }
    return RoundToInt(steps) + (this->Closed() ? 0 : 1);
  }

  Camera ReadKey(const Json& key, const std::string& where) const
  {
    if (!key.is_object())
    {
      throw UsageError(where, "has the wrong type", key.type_name(), "an object");
    }
    CheckKeys(key,
      { "camera", "K", "R", "t", "position", "lookAt", "up", "fieldOfView", "frame", "time" },
      where);
    const bool named = key.contains("camera");
    const bool posed = key.contains("R") || key.contains("t");
    const bool looking = key.contains("position") || key.contains("lookAt") || key.contains("up");
    if (named + posed + looking != 1)
    {
      throw UsageError(where, "does not state its position in one of the three ways",
        std::to_string(named + posed + looking) + " ways",
        "camera, or R and t, or position and lookAt");
    }
    Camera camera = named ? this->NamedKey(key["camera"], where)
      : posed             ? this->PosedKey(key, where)
                          : this->LookingKey(key, where);
    this->SetLens(camera, key, where);
    camera.Width = this->Usual.Width;
    camera.Height = this->Usual.Height;
    return camera;
  }

  Camera NamedKey(const Json& name, const std::string& where) const
  {
    if (!name.is_string() && !name.is_number_unsigned())
    {
      throw UsageError(where, "has the wrong type", name.type_name(), "a name or a number from 0");
    }
    Photograph named;
    named.Name = name.is_string() ? name.get<std::string>() : DumpJson(name);
    named.Cam = CameraOf(named.Name, this->Dataset);
    return InFrame(named, this->First.Width, this->First.Height, "the first photograph");
  }

  Camera PosedKey(const Json& key, const std::string& where) const
  {
    if (!key.contains("R") || !key.contains("t"))
    {
      throw UsageError(where, "R and t go together");
    }
    Camera camera = this->Usual;
    camera.R = MatrixOf(key["R"], where + ", R");
    camera.T = VectorOf(key["t"], where + ", t");
    return camera;
  }

  Camera LookingKey(const Json& key, const std::string& where) const
  {
    if (!key.contains("position") || !key.contains("lookAt"))
    {
      throw UsageError(where, "position and lookAt go together");
    }
    const Vector3d position = VectorOf(key["position"], where + ", position");
    const Vector3d target = VectorOf(key["lookAt"], where + ", lookAt");
    const Vector3d up = key.contains("up") ? VectorOf(key["up"], where + ", up") : this->Up;
    const double across = (target - position).normalized().cross(up.normalized()).norm();
    if (!(across > 1e-6))
    {
      throw UsageError(where, "has a view direction along its up vector, or none");
    }
    return LookAt(position, target, up, this->Usual.K, this->Usual.Width, this->Usual.Height);
  }

  void SetLens(Camera& camera, const Json& key, const std::string& where) const
  {
    if (key.contains("K"))
    {
      camera.K = MatrixOf(key["K"], where + ", K");
    }
    if (key.contains("fieldOfView"))
    {
      const double fieldDeg = NumberOf(key["fieldOfView"], where + ", fieldOfView");
      if (key.contains("K") || !(fieldDeg > 0.1 && fieldDeg < 175))
      {
        throw UsageError(where, "fieldOfView is not one, or beside K",
          JsonTypeText(key["fieldOfView"]), "0.1 to 175 degrees, without K");
      }
      const double height = this->Usual.Height;
      const double focal = height / (2 * std::tan(fieldDeg * EIGEN_PI / 360));
      camera.K << focal, 0, (this->Usual.Width - 1) / 2.0, 0, focal, (height - 1) / 2.0, 0, 0, 1;
    }
  }

  const TrajectoryOptions& Options;
  const DatasetIndex& Dataset;
  const Camera First; ///< the first photograph's
  Camera Usual;       ///< the first photograph's, for what a key does not say
  const std::string File;
  Json Whole;
  Vector3d Up;
};
}

std::vector<Camera> CamerasOfFrames(const TrajectoryOptions& options, const DatasetIndex& dataset,
  const std::vector<std::string>& exclude)
{
  // As they will be when they are read from the file that is written of them.
  const CameraGrid grid(dataset.Cameras);
  if (!options.Path.empty())
  {
    std::vector<Camera> path = PathReader(options, dataset).Cameras();
    std::transform(path.begin(), path.end(), path.begin(),
      [&](const Camera& camera) { return grid.Rounded(camera); });
    return path;
  }
  const std::vector<Photograph> photographs = WithoutExcluded(dataset, exclude);
  const Photograph& front = photographs.front();
  const Camera first = SizedCamera(front);
  std::vector<Camera> cameras;
  for (const Photograph& photograph : photographs)
  {
    cameras.push_back(grid.Rounded(InFrame(photograph, first.Width, first.Height, front.Name)));
  }
  CameraRing ring;
  try
  {
    ring = FitCameraRing(cameras);
  }
  catch (const Error& error)
  {
    throw UsageError(dataset.Calibration.string(),
      std::string(error.what()) + "; use --path to define the path of the camera");
  }
  const int count = options.Frames > 0 ? options.Frames : UsualFrames;
  std::vector<Camera> frames;
  for (int frame = 0; frame < count; ++frame)
  {
    frames.push_back(grid.Rounded(ring.At(static_cast<double>(frame) / count)));
  }
  return frames;
}
}
