// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/OutlierSearch.h"

#include "base/NumberText.h"
#include "core/Quantile.h"
#include "images/ImageFile.h"
#include "images/Metrics.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
constexpr int TotalRays = 2400; ///< of each kind, over all views

/** From this part of the others' contour rays on, a view that stands out is outlier. */
constexpr double MinExclusivelyCarved = 0.05;
/** An outlier exceeds the median view by this factor. */
constexpr double Outstanding = 4;
/** A silhouette so much less in the hull than the median one holds what the object is not. */
constexpr double LowIou = 0.08;
/** What views that belong together have at least. */
constexpr double MinMean = 0.9;

std::string Percent(double share)
{
  return std::to_string(std::lround(100 * share)) + " %";
}
}

OutlierSearch::OutlierSearch(const std::vector<Photograph>& cameras,
  CheckedSilhouettes& silhouettes, const std::vector<FoundMask>& masks,
  const SilhouetteOptions& silhouette, const Execution& execution)
  : Cameras(cameras)
  , Silhouettes(silhouettes)
  , Masks(masks)
  , Extraction(silhouette)
  , Run(execution)
  , Active(silhouettes.Ids())
  , ExclusivelyCarved(cameras.size(), 0)
{
}

std::string OutlierSearch::OutlierNames() const
{
  std::vector<std::string> names;
  for (const OutlierView& outlier : this->Found)
  {
    names.push_back(this->Cameras[outlier.CameraId].Name);
  }
  return Joined(names, ",");
}

AgreementSurvey OutlierSearch::Survey(const std::vector<int>& ids) const
{
  const int rays = std::clamp(TotalRays / std::max(static_cast<int>(ids.size()), 1), 40, 400);
  return SurveyAgreement(this->Silhouettes.ViewsOf(this->Cameras, ids), rays, this->Run);
}

/** The view to be left out next, as an index into what was surveyed. */
std::optional<std::size_t> OutlierSearch::Suspect(const AgreementSurvey& survey)
{
  if (survey.Iou.size() < 3)
  {
    return std::nullopt;
  }
  const std::size_t most = static_cast<std::size_t>(
    std::max_element(survey.ExclusivelyCarved.begin(), survey.ExclusivelyCarved.end()) -
    survey.ExclusivelyCarved.begin());
  if (survey.ExclusivelyCarved[most] >
    std::max(MinExclusivelyCarved, Outstanding * Quantile(survey.ExclusivelyCarved, 0.5)))
  {
    return most;
  }
  const std::size_t least = static_cast<std::size_t>(
    std::min_element(survey.Iou.begin(), survey.Iou.end()) - survey.Iou.begin());
  if (survey.Iou[least] < Quantile(survey.Iou, 0.5) - LowIou)
  {
    return least;
  }
  return std::nullopt;
}

void OutlierSearch::LeaveOut()
{
  const std::size_t most = std::max<std::size_t>(1, this->Active.size() / 3);
  while (this->Out.size() < most)
  {
    const std::optional<std::size_t> suspect = Suspect(this->Last);
    if (!suspect)
    {
      return;
    }
    const int id = this->Active[*suspect];
    this->ExclusivelyCarved[id] = this->Last.ExclusivelyCarved[*suspect];
    this->Out.push_back(id);
    this->Active.erase(this->Active.begin() + static_cast<std::ptrdiff_t>(*suspect));
    this->Last = this->Survey(this->Active);
  }
}

/** Whether these views, which are left out, agree with those that are not. */
bool OutlierSearch::AgreesWithRest(const std::vector<int>& more) const
{
  std::vector<int> ids = this->Active;
  ids.insert(ids.end(), more.begin(), more.end());
  const AgreementSurvey survey = this->Survey(ids);
  for (std::size_t i = this->Active.size(); i < ids.size(); ++i)
  {
    const bool against = survey.ExclusivelyCarved[i] >
      std::max(MinExclusivelyCarved, Outstanding * Quantile(survey.ExclusivelyCarved, 0.5));
    if (against || survey.Iou[i] < Quantile(survey.Iou, 0.5) - LowIou)
    {
      return false;
    }
  }
  // If the remaining views do not agree, nothing is proved.
  return survey.MeanIou > MinMean;
}

/** Views that were left out while another one was the culprit. */
void OutlierSearch::Reinstate()
{
  const std::vector<int> out = this->Out;
  for (const int id : out)
  {
    if (this->AgreesWithRest({ id }))
    {
      std::erase(this->Out, id);
      this->Active.push_back(id);
      std::sort(this->Active.begin(), this->Active.end());
    }
  }
  if (this->Out.size() != out.size())
  {
    this->Last = this->Survey(this->Active);
  }
}

/** Whether a view that is left out agrees with another silhouette. */
bool OutlierSearch::AgreesWith(int id, const FoundMask& mask, bool invert)
{
  CheckedSilhouettes kept = this->Silhouettes;
  const bool agrees =
    this->Silhouettes.Replace(id, this->Cameras[id], mask, invert) && this->AgreesWithRest({ id });
  this->Silhouettes = std::move(kept);
  return agrees;
}

/** What stands against a view, in words. */
std::string OutlierSearch::DescribeExclusivelyCarved(int id) const
{
  const auto used = std::find(this->Silhouettes.Ids().begin(), this->Silhouettes.Ids().end(), id);
  const double iou =
    this->First.Iou[static_cast<std::size_t>(used - this->Silhouettes.Ids().begin())];
  return this->ExclusivelyCarved[id] > MinExclusivelyCarved
    ? "it alone rules out " + Percent(this->ExclusivelyCarved[id]) +
      " of where the others see the object's outline"
    : "only " + Percent(iou) + " of its silhouette lies in the hull";
}

/** The silhouette that a photograph shows. */
Image<std::uint8_t> OutlierSearch::Seen(int id) const
{
  const Photograph& photograph = this->Cameras[id];
  return ExtractSilhouette(
    ReadColorFile(photograph.File, photograph.Reading).Ref(), this->Extraction);
}

/** Two views whose silhouettes agree when they are swapped. */
void OutlierSearch::ExplainSwaps()
{
  for (std::size_t i = 0; i < this->Out.size(); ++i)
  {
    for (std::size_t j = i + 1; j < this->Out.size(); ++j)
    {
      const int a = this->Out[i];
      const int b = this->Out[j];
      this->Silhouettes.Swap(a, b);
      const bool agree = this->AgreesWithRest({ a, b });
      this->Silhouettes.Swap(a, b);
      if (!agree)
      {
        continue;
      }
      const Image<std::uint8_t> seen = this->Seen(a);
      const bool masks =
        MaskIou(seen, this->Masks[b].Pixels) > MaskIou(seen, this->Masks[a].Pixels) + 0.05;
      for (const auto& [id, other] : { std::pair(a, b), std::pair(b, a) })
      {
        this->Found.push_back({ id, "swapped",
          (masks ? "its mask and that of " : "it and ") + this->Cameras[other].Name +
            (masks ? " are swapped" : " are swapped: photographs and masks, or cameras") });
      }
      this->Out.erase(this->Out.begin() + static_cast<std::ptrdiff_t>(j));
      this->Out.erase(this->Out.begin() + static_cast<std::ptrdiff_t>(i));
      this->ExplainSwaps();
      return;
    }
  }
}

/** Determines the cause from the photograph itself. */
OutlierView OutlierSearch::ExplainByPhotograph(int id)
{
  const std::string against = this->DescribeExclusivelyCarved(id);
  const FoundMask& mask = this->Masks[id];
  if (mask.Source == MaskSource::Extracted)
  {
    return { id, "view",
      "does not fit the others: " + against +
        "; the silhouette extracted from the photograph, the photograph or its camera is wrong" };
  }
  const FoundMask seen{ this->Seen(id), MaskSource::Extracted };
  if (this->AgreesWith(id, seen, false))
  {
    return { id, "mask",
      "its mask is wrong: " + against + "; the silhouette that the photograph shows would agree" };
  }
  if (MaskIou(seen.Pixels, mask.Pixels) > 0.9)
  {
    return { id, "camera",
      "its camera is wrong, or the photograph is of something else: " + against +
        ", while its mask is what the photograph shows" };
  }
  return { id, "view", "does not fit the others: " + against + "; its mask or camera is wrong" };
}

OutlierView OutlierSearch::ExplainOne(int id)
{
  const FoundMask& mask = this->Masks[id];
  if (mask.Source != MaskSource::Extracted)
  {
    // Whether all are inverted is settled; this one is the other way round than those.
    for (const bool invert : { false, true })
    {
      if (this->AgreesWith(id, mask, invert))
      {
        return { id, "mask-inverted", "its mask is inverted, unlike the others" };
      }
    }
  }
  for (const int other : this->Silhouettes.Ids())
  {
    // Two views of one object hardly ever show it in exactly the same shape and place.
    if (other != id && mask.Source != MaskSource::Extracted &&
      MaskIou(mask.Pixels, this->Masks[other].Pixels) > 0.998)
    {
      return { id, "mask-of-another", "its mask is that of " + this->Cameras[other].Name };
    }
  }
  return this->ExplainByPhotograph(id);
}

void OutlierSearch::Explain()
{
  this->ExplainSwaps();
  for (const int id : this->Out)
  {
    this->Found.push_back(this->ExplainOne(id));
  }
  std::sort(this->Found.begin(), this->Found.end(),
    [](const OutlierView& a, const OutlierView& b) { return a.CameraId < b.CameraId; });
}

void OutlierSearch::Examine(std::vector<CheckedCamera>& agreement)
{
  agreement.assign(this->Cameras.size(), {});
  if (this->Active.size() < 2)
  {
    return;
  }
  this->First = this->Survey(this->Active);
  const std::vector<int> all = this->Active;
  this->Last = this->First;
  this->LeaveOut();
  this->Reinstate();
  if (this->Last.MeanIou < MinMean)
  {
    // Nothing is won by leaving these out, so there is no reason to blame them.
    this->Out.clear();
    this->Active = all;
    this->Last = this->First;
  }
  this->Explain();
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    CheckedCamera& camera = agreement[all[i]];
    camera.TakesPart = true;
    camera.Iou = this->First.Iou[i];
    camera.ExclusivelyCarved = this->First.ExclusivelyCarved[i];
  }
  for (const OutlierView& outlier : this->Found)
  {
    agreement[outlier.CameraId].Outlier = true;
  }
  for (std::size_t i = 0; i < this->Active.size() && !this->Found.empty(); ++i)
  {
    agreement[this->Active[i]].IouAfter = this->Last.Iou[i];
  }
}
}
