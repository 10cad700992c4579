// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/ConventionTrials.h"

#include "base/NumberText.h"
#include "check/AgreementSurvey.h"
#include "core/Error.h"
#include "formats/DatasetFormats.h"

#include <algorithm>
#include <optional>

namespace novelview
{
namespace fs = std::filesystem;

CameraConvention OwnConvention(const fs::path& folder, const DatasetSource& source)
{
  const FoundCalibration found = ChooseCalibration(folder, source.Calibration, source.Format);
  return found.Format->Read(folder, found.File).Convention;
}

std::vector<std::string> ConventionOptions(
  const CameraConvention& own, const CameraConvention& wanted)
{
  std::vector<std::string> words;
  const auto add = [&words](bool differs, const std::vector<std::string>& option)
  {
    if (differs)
    {
      words.insert(words.end(), option.begin(), option.end());
    }
  };
  add(wanted.Axes != own.Axes, { "--axes", wanted.Axes });
  add(wanted.Poses != own.Poses, { "--poses", wanted.Poses });
  add(wanted.RotationOrder != own.RotationOrder, { "--rotation-order", wanted.RotationOrder });
  add(wanted.PixelCentre != own.PixelCentre,
    { "--pixel-centre", NumberText(wanted.PixelCentre.value_or(0)) });
  add(wanted.FlipY != own.FlipY, { "--flip-y" });
  add(wanted.InvertMasks != own.InvertMasks, { "--invert-masks" });
  return words;
}

DatasetSource SourceReadAs(
  const DatasetSource& source, const CameraConvention& own, const CameraConvention& wanted)
{
  DatasetSource read = source;
  read.Convention = wanted;
  read.Convention.FlipY = wanted.FlipY != own.FlipY;
  read.Convention.InvertMasks = wanted.InvertMasks != own.InvertMasks;
  return read;
}

namespace
{
const char* Other(const std::string& value, const char* a, const char* b)
{
  return value == a ? b : a;
}

/** Every combination of the four mistakes; bit i of the number is set if i is changed. */
std::vector<ConventionTrial> AllTrials(const CameraConvention& own, const CameraConvention& now)
{
  std::vector<ConventionTrial> trials;
  for (int bits = 0; bits < 16; ++bits)
  {
    ConventionTrial trial;
    trial.Convention = now;
    CameraConvention& convention = trial.Convention;
    if (bits & 1)
    {
      convention.Poses = Other(now.Poses, "world-to-camera", "camera-to-world");
      trial.Changes.push_back("poses");
    }
    if (bits & 2)
    {
      convention.Axes = Other(now.Axes, "opencv", "opengl");
      trial.Changes.push_back("axes");
    }
    if (bits & 4)
    {
      convention.RotationOrder = Other(now.RotationOrder, "row", "column");
      trial.Changes.push_back("rotation order");
    }
    if (bits & 8)
    {
      convention.FlipY = !now.FlipY;
      trial.Changes.push_back("y");
    }
    trial.Options = ConventionOptions(own, convention);
    trials.push_back(trial);
  }
  return trials;
}
}

std::vector<ConventionTrial> TryConventions(const fs::path& folder, const DatasetSource& source,
  const std::vector<std::string>& exclude, const std::vector<FoundMask>& masks, bool invert,
  const Execution& execution)
{
  constexpr int TrialSize = 320; // px; conventions are wrong by far more than a pixel
  constexpr int TrialRays = 60;
  const CameraConvention own = OwnConvention(folder, source);
  std::vector<ConventionTrial> trials = AllTrials(own, Override(own, source.Convention));
  std::vector<Photograph> sized;
  std::optional<CheckedSilhouettes> silhouettes;
  for (std::size_t i = 0; i < trials.size(); ++i)
  {
    ConventionTrial& trial = trials[i];
    execution.Report(static_cast<double>(i) / static_cast<double>(trials.size()));
    std::vector<Photograph> cameras;
    try
    {
      DatasetSource read = SourceReadAs(source, own, trial.Convention);
      read.ExifOrientation = "ignore"; // masks are read already
      const DatasetIndex index = ReadDatasetIndex(folder, read);
      cameras = WithoutExcluded(index, exclude);
    }
    catch (const Error&)
    {
      trial.Readable = false; // e.g. a lens that cannot be flipped
      continue;
    }
    const bool distorted = std::any_of(cameras.begin(), cameras.end(),
      [](const Photograph& each) { return !each.Distortion.IsPinhole(); });
    const bool flips = i > 0 && trial.Convention.FlipY != trials[i - 1].Convention.FlipY;
    if (!silhouettes || (distorted && flips))
    {
      silhouettes.emplace(cameras, masks, invert, TrialSize);
    }
    const std::vector<View> views = silhouettes->ViewsOf(cameras, silhouettes->Ids());
    Execution quiet = execution;
    quiet.Progress = [](double) { return true; };
    trial.Iou = SurveyAgreement(views, TrialRays, quiet).RobustIou;
  }
  return trials;
}

std::size_t ChooseTrial(const std::vector<ConventionTrial>& trials)
{
  constexpr double AboutEqual = 0.02;
  double best = 0;
  for (const ConventionTrial& trial : trials)
  {
    best = std::max(best, trial.Iou);
  }
  std::size_t chosen = 0;
  bool found = false;
  for (std::size_t i = 0; i < trials.size(); ++i)
  {
    if (trials[i].Iou >= best - AboutEqual &&
      (!found || trials[i].Changes.size() < trials[chosen].Changes.size()))
    {
      chosen = i;
      found = true;
    }
  }
  return chosen;
}
}
