// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/CheckSilhouettes.h"

#include "base/NumberText.h"
#include "base/Parallel.h"
#include "formats/DatasetFormats.h"
#include "images/OpenCvPixels.h"
#include "silhouettes/ContourDistance.h"
#include "silhouettes/HullConsistency.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/** A ray agrees when it comes this near to the hull, px: rim pixels are a matter of rounding. */
constexpr double TolerancePx = 1;

double MeanOf(const std::vector<double>& values)
{
  double sum = 0;
  for (const double value : values)
  {
    sum += value;
  }
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/** Part of the frame's border that is object. */
double BorderShare(const Image<std::uint8_t>& mask)
{
  int object = 0;
  for (int x = 0; x < mask.Width; ++x)
  {
    object += (mask(x, 0) > 127) + (mask(x, mask.Height - 1) > 127);
  }
  for (int y = 0; y < mask.Height; ++y)
  {
    object += (mask(0, y) > 127) + (mask(mask.Width - 1, y) > 127);
  }
  return object / (2.0 * (mask.Width + mask.Height));
}

bool HasContour(const Image<std::uint8_t>& mask)
{
  const auto object =
    std::count_if(mask.Values.begin(), mask.Values.end(), [](std::uint8_t v) { return v > 127; });
  return object > 0 && object < static_cast<std::ptrdiff_t>(mask.Values.size());
}
}

//------------------------------------------------------------------------------
CheckedSilhouettes::CheckedSilhouettes(const std::vector<Photograph>& cameras,
  const std::vector<FoundMask>& masks, bool invert, int workingSize)
  : Size(workingSize)
  , All(cameras.size())
{
  ParallelForEach(cameras.size(),
    [&](std::size_t i) { this->All[i] = Reduce(cameras[i], masks[i], invert, workingSize); });
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    if (!this->All[i].Distance.Values.empty())
    {
      this->Used.push_back(static_cast<int>(i));
    }
  }
}

CheckedSilhouettes::Reduced CheckedSilhouettes::Reduce(
  const Photograph& camera, const FoundMask& found, bool invert, int workingSize)
{
  const Image<std::uint8_t>& mask = found.Pixels;
  Reduced reduced;
  if (!HasContour(mask))
  {
    return reduced;
  }
  reduced.Mask = mask;
  if (invert && found.Source != MaskSource::Extracted)
  {
    for (std::uint8_t& value : reduced.Mask.Values)
    {
      value = static_cast<std::uint8_t>(255 - value);
    }
  }
  if (!camera.Distortion.IsPinhole())
  {
    reduced.Mask = Undistorted(reduced.Mask.Ref(), camera.Distortion, camera.Cam.K);
  }
  reduced.BorderShare = BorderShare(reduced.Mask);
  const int longer = std::max(mask.Width, mask.Height);
  if (longer > workingSize)
  {
    // Whole pixels are averaged, so that the contour keeps its place to a fraction of a pixel.
    const int factor = (longer + workingSize - 1) / workingSize;
    const cv::Mat whole = ToMat(ImageRef<const std::uint8_t>(reduced.Mask.Ref()));
    const cv::Rect used(0, 0, whole.cols / factor * factor, whole.rows / factor * factor);
    cv::Mat small;
    cv::resize(whole(used), small, used.size() / factor, 0, 0, cv::INTER_AREA);
    reduced.Mask = FromMat<std::uint8_t>(small);
    reduced.Reduction = factor;
  }
  if (!HasContour(reduced.Mask))
  {
    return {};
  }
  reduced.Distance = SignedContourDistance(reduced.Mask.Ref());
  return reduced;
}

bool CheckedSilhouettes::Replace(
  int id, const Photograph& camera, const FoundMask& mask, bool invert)
{
  Reduced reduced = Reduce(camera, mask, invert, this->Size);
  if (reduced.Distance.Values.empty())
  {
    return false;
  }
  this->All[id] = std::move(reduced);
  return true;
}

std::vector<View> CheckedSilhouettes::ViewsOf(
  const std::vector<Photograph>& cameras, const std::vector<int>& ids) const
{
  std::vector<View> views;
  for (const int id : ids)
  {
    const Reduced& reduced = this->All[id];
    View view;
    view.Name = cameras[id].Name;
    view.Cam = cameras[id].Cam;
    view.Cam.Width = reduced.Mask.Width;
    view.Cam.Height = reduced.Mask.Height;
    // Pixel centres are integers: x + 0.5 is what scales.
    view.Cam.K.topRows<2>() /= reduced.Reduction;
    view.Cam.K.block<2, 1>(0, 2).array() += 0.5 / reduced.Reduction - 0.5;
    view.Mask = reduced.Mask.Ref();
    view.ContourDistance = reduced.Distance.Ref();
    views.push_back(view);
  }
  return views;
}

//------------------------------------------------------------------------------
namespace
{
/** Numbers of rays that agree: with all views, and without each. */
struct Tally
{
  explicit Tally(std::size_t views)
    : Without(views, 0)
  {
  }
  void Add(const RayConsistency& ray)
  {
    ++this->Rays;
    this->Agreeing += ray.Residual >= -TolerancePx;
    for (std::size_t k = 0; k < ray.Without.size(); ++k)
    {
      this->Without[k] += ray.Without[k] >= -TolerancePx;
    }
  }
  double Share() const { return this->Rays > 0 ? this->Agreeing / this->Rays : 0; }
  double ShareWithout(std::size_t k) const
  {
    return this->Rays > 0 ? this->Without[k] / this->Rays : 0;
  }

  double Rays = 0;
  double Agreeing = 0;
  std::vector<double> Without;
};

std::vector<Tally> TallyOf(const std::vector<SilhouetteRay>& rays,
  const std::vector<RayConsistency>& agreements, std::size_t views)
{
  std::vector<Tally> tallies(views, Tally(views));
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    tallies[rays[i].ViewId].Add(agreements[i]);
  }
  return tallies;
}

/** Rays of one kind of all views. */
template <class RaysOfView>
std::vector<SilhouetteRay> AllRays(
  const std::vector<View>& views, int count, const RaysOfView& raysOfView)
{
  std::vector<SilhouetteRay> rays;
  for (std::size_t id = 0; id < views.size(); ++id)
  {
    const auto own = raysOfView(views, static_cast<int>(id), count);
    rays.insert(rays.end(), own.begin(), own.end());
  }
  return rays;
}

void FillIou(const std::vector<Tally>& tallies, AgreementSurvey& survey)
{
  const std::size_t count = tallies.size();
  for (const Tally& tally : tallies)
  {
    survey.Iou.push_back(tally.Share());
  }
  survey.MeanIou = MeanOf(survey.Iou);
  survey.RobustIou = survey.MeanIou;
  for (std::size_t k = 0; k < count; ++k)
  {
    double sum = 0;
    for (std::size_t v = 0; v < count; ++v)
    {
      sum += v == k ? 0 : tallies[v].ShareWithout(k);
    }
    survey.MeanIouWithout.push_back(count > 1 ? sum / static_cast<double>(count - 1) : 0);
    survey.RobustIou = std::max(survey.RobustIou, survey.MeanIouWithout.back());
  }
}
}

AgreementSurvey SurveyAgreement(
  const std::vector<View>& views, int rays, const Execution& execution)
{
  AgreementSurvey survey;
  HullConsistencyOptions options;
  options.WithoutEach = true;
  const std::vector<SilhouetteRay> area = AllRays(views, rays, AreaRays);
  const auto areaAgreements = FollowSilhouetteRays(views, area, options, execution);
  FillIou(TallyOf(area, areaAgreements, views.size()), survey);
  for (const RayConsistency& agreement : areaAgreements)
  {
    if (agreement.Residual >= 0)
    {
      survey.Points.push_back(agreement.Point);
    }
  }
  const std::vector<SilhouetteRay> contour = AllRays(views, rays, ContourRays);
  const auto tallies =
    TallyOf(contour, FollowSilhouetteRays(views, contour, options, execution), views.size());
  for (std::size_t k = 0; k < views.size(); ++k)
  {
    double count = 0;
    double freed = 0;
    for (std::size_t v = 0; v < views.size(); ++v)
    {
      count += v == k ? 0 : tallies[v].Rays;
      freed += v == k ? 0 : tallies[v].Without[k] - tallies[v].Agreeing;
    }
    survey.ExclusivelyCarved.push_back(count > 0 ? freed / count : 0);
  }
  return survey;
}

//------------------------------------------------------------------------------
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

/** Every combination of the four mistakes; bit i of the number says whether i is changed. */
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
      const DatasetIndex index =
        ReadDatasetIndex(folder, SourceReadAs(source, own, trial.Convention));
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

//------------------------------------------------------------------------------
namespace
{
/** Mean disagreement of contour rays per view, px, with all principal points shifted by this. */
std::vector<double> ContourLoss(const std::vector<View>& views,
  const std::vector<SilhouetteRay>& rays, double shiftPx, const Execution& execution)
{
  constexpr double MaxPx = 3; // what is further off says nothing about half pixels
  std::vector<View> shifted = views;
  for (View& view : shifted)
  {
    view.Cam.K.block<2, 1>(0, 2).array() += shiftPx;
  }
  std::vector<double> loss(views.size(), 0);
  std::vector<double> count(views.size(), 0);
  const auto agreements = FollowSilhouetteRays(shifted, rays, {}, execution);
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    loss[rays[i].ViewId] += std::clamp(-static_cast<double>(agreements[i].Residual), 0.0, MaxPx);
    count[rays[i].ViewId] += 1;
  }
  for (std::size_t v = 0; v < loss.size(); ++v)
  {
    loss[v] /= std::max(count[v], 1.0);
  }
  return loss;
}

/** Mean over standard error of the mean of b - a. */
double Significance(const std::vector<double>& a, const std::vector<double>& b)
{
  const double n = static_cast<double>(a.size());
  double sum = 0;
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += b[i] - a[i];
    squares += (b[i] - a[i]) * (b[i] - a[i]);
  }
  const double variance = (squares - sum * sum / n) / std::max(n - 1, 1.0);
  return variance > 0 ? sum / n / std::sqrt(variance / n) : 0;
}
}

PixelCentreVerdict ComparePixelCentres(
  const std::vector<View>& views, const std::vector<double>& shiftsPx, const Execution& execution)
{
  constexpr int Rays = 120;
  PixelCentreVerdict verdict;
  const std::vector<SilhouetteRay> rays = AllRays(views, Rays, ContourRays);
  std::vector<std::vector<double>> losses;
  for (const double shift : shiftsPx)
  {
    losses.push_back(ContourLoss(views, rays, shift, execution));
    verdict.LossPx.push_back(MeanOf(losses.back()));
  }
  verdict.Sigmas = Significance(losses[1], losses[0]);
  return verdict;
}
}
