// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset/ViewSpec.h"

#include "base/UsageError.h"
#include "cameras/CameraGrid.h"
#include "core/Error.h"
#include "images/ExifOrientation.h"
#include "images/ImageFile.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
const char* const Forms = "between:A,B[,FRACTION], like:IMAGE or file:PAR.txt#NAME";

[[noreturn]] void Refuse(const std::string& text, const std::string& what)
{
  throw UsageError("view", what, "'" + text + "'", Forms);
}

bool ParseFraction(const std::string& text, double& fraction)
{
  const auto [stop, failure] = std::from_chars(text.data(), text.data() + text.size(), fraction);
  return failure == std::errc() && stop == text.data() + text.size() && fraction >= 0 &&
    fraction <= 1;
}

ViewSpec ParseBetween(const std::string& text, const std::string& rest)
{
  ViewSpec spec;
  spec.What = ViewSpec::Kind::Between;
  const std::size_t first = rest.find(',');
  if (first == std::string::npos)
  {
    Refuse(text, "needs two cameras");
  }
  const std::size_t second = rest.find(',', first + 1);
  spec.From = rest.substr(0, first);
  spec.To =
    rest.substr(first + 1, second == std::string::npos ? std::string::npos : second - first - 1);
  if (spec.From.empty() || spec.To.empty())
  {
    Refuse(text, "needs two cameras");
  }
  if (second != std::string::npos && !ParseFraction(rest.substr(second + 1), spec.Fraction))
  {
    Refuse(text, "fraction is not a number from 0 to 1");
  }
  return spec;
}

ViewSpec ParseFile(const std::string& text, const std::string& rest)
{
  ViewSpec spec;
  spec.What = ViewSpec::Kind::File;
  const std::size_t hash = rest.rfind('#');
  if (hash == std::string::npos || hash == 0 || hash + 1 == rest.size())
  {
    Refuse(text, "needs a calibration file and a name in it");
  }
  spec.ParFile = rest.substr(0, hash);
  spec.Name = rest.substr(hash + 1);
  return spec;
}

template <class Named>
const Named& Find(
  const std::vector<Named>& cameras, const std::string& name, const std::string& where)
{
  for (const Named& camera : cameras)
  {
    if (camera.Name == name)
    {
      return camera;
    }
  }
  throw UsageError("view", where + " has no camera of this name", "'" + name + "'",
    "a name like " + (cameras.empty() ? "none" : cameras.front().Name));
}

/** A camera by its photograph's name or its number from 0. */
const Photograph& FindByNameOrNumber(const DatasetIndex& dataset, const std::string& text)
{
  std::size_t number = 0;
  const auto [stop, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure == std::errc() && stop == text.data() + text.size())
  {
    if (number >= dataset.Cameras.size())
    {
      throw UsageError("view", "there is no camera of this number", text,
        "0 to " + std::to_string(dataset.Cameras.size() - 1));
    }
    return dataset.Cameras[number];
  }
  const Photograph* const named = PhotographOfName(dataset.Cameras, text);
  return named ? *named : Find(dataset.Cameras, text, dataset.Calibration.string());
}

/** Sets the size to that of the image. */
void SetSizeFromImage(Camera& camera, const Photograph& photograph)
{
  const PictureSize size = ReadPictureSize(photograph.File);
  const bool turned = SwapsSides(photograph.Reading.Orientation);
  camera.Width = turned ? size.Height : size.Width;
  camera.Height = turned ? size.Width : size.Height;
}

/** Sets the size to that of a photograph, opening it only when its calibration does not say it. */
void SetSizeFrom(Camera& camera, const Photograph& photograph)
{
  if (photograph.Cam.Width == 0)
  {
    SetSizeFromImage(camera, photograph);
    return;
  }
  camera.Width = photograph.Cam.Width;
  camera.Height = photograph.Cam.Height;
}

ResolvedView ResolveFile(const ViewSpec& spec, const DatasetIndex& dataset)
{
  const Photograph found = Find(ReadViewCameras(spec.ParFile), spec.Name, spec.ParFile.string());
  ResolvedView view;
  view.Cam = found.Cam;
  std::error_code failure;
  if (fs::exists(found.File, failure))
  {
    view.Truth = found;
  }
  // A camera of the data set's own calibration: its photograph is the truth, so no stage uses it.
  for (const Photograph& own : dataset.Cameras)
  {
    if (!view.Truth.File.empty() && fs::exists(own.File, failure) &&
      fs::equivalent(view.Truth.File, own.File, failure))
    {
      view.HeldOut = own.Name;
      view.Truth = own;
    }
  }
  if (view.Cam.Width == 0)
  {
    SetSizeFrom(view.Cam, view.Truth.File.empty() ? dataset.Cameras.front() : view.Truth);
  }
  return view;
}
}

Camera SizedCamera(const Photograph& photograph)
{
  Camera camera = photograph.Cam;
  SetSizeFrom(camera, photograph);
  return camera;
}

Camera InFrame(const Photograph& photograph, int width, int height, const std::string& with)
{
  constexpr double alike = 0.01; // cropping changes more, rounding of sizes less
  Camera camera = SizedCamera(photograph);
  const double x = static_cast<double>(width) / camera.Width;
  const double y = static_cast<double>(height) / camera.Height;
  if (std::abs(x - y) <= alike * std::max(x, y))
  {
    // Pixel centres are integers: x + 0.5 is what scales.
    camera.K.topRows<2>() = Eigen::Vector2d(x, y).asDiagonal() * camera.K.topRows<2>();
    camera.K(0, 2) += (x - 1) / 2;
    camera.K(1, 2) += (y - 1) / 2;
  }
  else if (camera.Width == height && camera.Height == width)
  {
    camera.K(0, 2) += (width - camera.Width) / 2.0;
    camera.K(1, 2) += (height - camera.Height) / 2.0;
  }
  else
  {
    throw Error("view " + photograph.Name,
      "has another shape than " + with + ", so their cameras cannot be averaged",
      SizeText(camera.Width, camera.Height),
      SizeText(width, height) + ", or a size that is scaled or turned from it");
  }
  camera.Width = width;
  camera.Height = height;
  return camera;
}

ViewSpec ParseViewSpec(const std::string& text)
{
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (text.empty())
  {
    return {};
  }
  if (kind == "between")
  {
    return ParseBetween(text, rest);
  }
  if (kind == "file")
  {
    return ParseFile(text, rest);
  }
  if (kind != "like" || rest.empty())
  {
    Refuse(text, "is not a view");
  }
  ViewSpec spec;
  spec.What = ViewSpec::Kind::Like;
  spec.Name = rest;
  return spec;
}

std::string ViewSpecText(const ViewSpec& spec)
{
  char fraction[64];
  switch (spec.What)
  {
    case ViewSpec::Kind::Between:
      return "between:" + spec.From + "," + spec.To + "," +
        std::string(fraction, std::to_chars(fraction, fraction + 64, spec.Fraction).ptr);
    case ViewSpec::Kind::Like:
      return "like:" + spec.Name;
    case ViewSpec::Kind::File:
      return "file:" + spec.ParFile.string() + "#" + spec.Name;
    case ViewSpec::Kind::None:
      break;
  }
  return "";
}

WordTarget ViewTarget(ViewSpec& view)
{
  const auto set = [&view](const std::string& word, const std::string&, const PathMap& paths)
  {
    view = ParseViewSpec(word);
    view.ParFile = paths(view.ParFile);
  };
  const auto get = [&view](const PathMap& paths)
  {
    ViewSpec spec = view;
    spec.ParFile = paths(spec.ParFile);
    return ViewSpecText(spec);
  };
  return { "VIEW", "", set, get };
}

ResolvedView ResolveViewSpec(const ViewSpec& spec, const DatasetIndex& dataset)
{
  if (spec.What == ViewSpec::Kind::None || dataset.Cameras.empty())
  {
    throw UsageError("view", "none given", "nothing", Forms);
  }
  const CameraGrid grid(dataset.Cameras);
  ResolvedView view;
  if (spec.What == ViewSpec::Kind::File)
  {
    view = ResolveFile(spec, dataset);
    view.Cam = grid.Rounded(view.Cam);
    return view;
  }
  if (spec.What == ViewSpec::Kind::Like)
  {
    const Photograph& like = FindByNameOrNumber(dataset, spec.Name);
    view.Cam = grid.Rounded(like.Cam);
    view.HeldOut = like.Name;
    view.Truth = like;
    SetSizeFrom(view.Cam, like);
    return view;
  }
  const Photograph& from = FindByNameOrNumber(dataset, spec.From);
  const Photograph& to = FindByNameOrNumber(dataset, spec.To);
  const Camera start = grid.Rounded(SizedCamera(from));
  const Camera end = grid.Rounded(InFrame(to, start.Width, start.Height, from.Name));
  view.Cam = InterpolateOnOrbit(start, end, spec.Fraction);
  return view;
}
}
