// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset/ViewSpec.h"

#include "base/UsageError.h"
#include "cameras/CameraGrid.h"
#include "dataset/PhotographSize.h"

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

}

ResolvedView ResolveCamera(Photograph found, const DatasetIndex& dataset)
{
  ResolvedView view;
  std::error_code failure;
  if (fs::exists(found.File, failure))
  {
    // A picture is compared at the size of the others.
    Reduce(found, dataset.MaxSize);
    view.Truth = found;
  }
  view.Cam = found.Cam;
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
    const Camera like = SizedCamera(view.Truth.File.empty() ? dataset.Cameras.front() : view.Truth);
    view.Cam.Width = like.Width;
    view.Cam.Height = like.Height;
  }
  view.Cam = CameraGrid(dataset.Cameras).Rounded(view.Cam);
  return view;
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
    return ResolveCamera(
      Find(ReadViewCameras(spec.ParFile), spec.Name, spec.ParFile.string()), dataset);
  }
  if (spec.What == ViewSpec::Kind::Like)
  {
    const Photograph& like = FindByNameOrNumber(dataset, spec.Name);
    view.Cam = grid.Rounded(SizedCamera(like));
    view.HeldOut = like.Name;
    view.Truth = like;
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
