// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/AgreementSurvey.h"

#include "silhouettes/HullConsistency.h"

#include <algorithm>

namespace novelview
{
namespace
{
/**
 * A ray agrees if its distance to the hull is at most this, px: boundary pixels depend on rounding.
 */
constexpr double TolerancePx = 1;

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

double MeanOf(const std::vector<double>& values)
{
  double sum = 0;
  for (const double value : values)
  {
    sum += value;
  }
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

std::vector<SilhouetteRay> AllRays(const std::vector<View>& views, int count,
  std::vector<SilhouetteRay> (*raysOfView)(const std::vector<View>&, int, int))
{
  std::vector<SilhouetteRay> rays;
  for (std::size_t id = 0; id < views.size(); ++id)
  {
    const auto own = raysOfView(views, static_cast<int>(id), count);
    rays.insert(rays.end(), own.begin(), own.end());
  }
  return rays;
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
}
