// SPDX-License-Identifier: GPL-3.0-or-later
#include "silhouettes/HullConsistency.h"

#include "core/ToInt.h"
#include "silhouettes/SilhouetteWitness.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int MaxSteps = 4096; ///< along a ray, whatever the cameras are

/** The silhouettes of the other views at a point. */
struct PointVerdict
{
  double Min = std::numeric_limits<double>::infinity();
  double Second = std::numeric_limits<double>::infinity();
  int MinId = -1; ///< index of the other view with Min
  int Seen = 0;
  double Shortfall = 0; ///< without MinId: how far the point is from being any better
};

/** Follows one ray at a time. */
class AgreementFollower
{
public:
  AgreementFollower(
    const std::vector<SilhouetteWitness>& witnesses, const HullConsistencyOptions& options)
    : Witnesses(witnesses)
    , Options(options)
  {
  }

  RayConsistency Follow(const SilhouetteRay& ray)
  {
    RayConsistency result;
    result.Residual = static_cast<float>(-this->Options.FloorPx);
    this->Project(ray);
    if (this->Options.WithoutEach)
    {
      result.Without.assign(this->Witnesses.size(), result.Residual);
    }
    const RayRange range = this->CommonRange();
    if (this->Lines.empty() || range.Empty())
    {
      return result;
    }
    const int needed = std::max(1, CeilToInt(this->Options.SeenShare * this->Lines.size()));
    const int steps = this->StepsIn(range);
    this->BestAt = range.From;
    // A look every now and then first: the better the best, the more can be skipped.
    for (const int stride : { CoarseStride, 1 })
    {
      for (int i = 0; i <= steps;)
      {
        const double q = range.From + (range.To - range.From) * i / steps;
        i += std::max(stride, this->Visit(q, needed, result));
      }
    }
    for (float& without : result.Without)
    {
      without = std::max(without, result.Residual);
    }
    result.Point = this->Origin + this->BestAt * this->Scale / (1 - this->BestAt) * this->Direction;
    return result;
  }

private:
  static constexpr int CoarseStride = 16;

  /** Takes a point into account; returns the number of steps in which no point is any better. */
  int Visit(double q, int needed, RayConsistency& result)
  {
    const PointVerdict verdict = this->Judge(q, result.Residual);
    if (verdict.MinId < 0)
    {
      // Distances change by no more than twice the step (that much only outside the frame).
      return ToInt(verdict.Shortfall / (2 * this->Options.StepPx));
    }
    if (verdict.Seen < needed)
    {
      return 0;
    }
    if (verdict.Min > result.Residual)
    {
      result.Residual = static_cast<float>(verdict.Min);
      this->BestAt = q;
    }
    if (this->Options.WithoutEach)
    {
      float& without = result.Without[this->Ids[verdict.MinId]];
      without = std::max(without, static_cast<float>(verdict.Second));
    }
    return 0;
  }

  void Project(const SilhouetteRay& ray)
  {
    const Camera& camera = this->Witnesses[ray.ViewId].Cam;
    this->Origin = camera.Centre();
    this->Direction = camera.RayDirection(ray.Pixel);
    this->Ids.clear();
    this->Scale = 0;
    for (std::size_t id = 0; id < this->Witnesses.size(); ++id)
    {
      if (static_cast<int>(id) != ray.ViewId)
      {
        this->Ids.push_back(static_cast<int>(id));
        this->Scale = std::max(this->Scale, (this->Witnesses[id].Cam.Centre() - Origin).norm());
      }
    }
    this->Scale = this->Scale > 0 ? this->Scale : 1;
    this->Lines.clear();
    for (const int id : this->Ids)
    {
      this->Lines.push_back(this->Witnesses[id].Line(this->Origin, this->Scale * this->Direction));
    }
    this->Asked = 0;
  }

  /** Where at most as many views as may be left out rule a ray out by their frame alone. */
  RayRange CommonRange() const
  {
    std::vector<double> from;
    std::vector<double> to;
    for (std::size_t i = 0; i < this->Lines.size(); ++i)
    {
      const RayRange range =
        this->Witnesses[this->Ids[i]].Range(this->Lines[i], this->Options.FloorPx);
      from.push_back(range.Empty() ? 1 : range.From);
      to.push_back(range.Empty() ? 0 : range.To);
    }
    if (from.empty())
    {
      return { 1, 0 };
    }
    std::sort(from.begin(), from.end(), std::greater<>());
    std::sort(to.begin(), to.end());
    const std::size_t rank = this->Options.WithoutEach && from.size() > 1 ? 1 : 0;
    // Infinity itself is no point.
    return { from[rank], std::min(to[rank], 1 - 1e-9) };
  }

  /** So many that no step is longer than StepPx in any picture. */
  int StepsIn(const RayRange& range) const
  {
    constexpr int Parts = 16;
    double longest = 0;
    for (const PictureLine& line : this->Lines)
    {
      Vector2d before = Vector2d::Zero();
      bool known = false;
      for (int part = 0; part <= Parts; ++part)
      {
        const Vector3d h = line.At(range.From + (range.To - range.From) * part / Parts);
        const bool front = h.z() > 0;
        const Vector2d at = front ? Vector2d(h.hnormalized()) : Vector2d::Zero();
        if (front && known)
        {
          longest = std::max(longest, (at - before).norm());
        }
        before = at;
        known = front;
      }
    }
    const double steps = std::ceil(Parts * longest / this->Options.StepPx);
    return ToInt(ClampedNumber(steps, 1, MaxSteps));
  }

  /** No verdict (MinId -1) when the point cannot be better than what is known already. */
  PointVerdict Judge(double q, double residual)
  {
    PointVerdict verdict;
    const std::size_t count = this->Lines.size();
    for (std::size_t n = 0; n < count; ++n)
    {
      const std::size_t i = (this->Asked + n) % count;
      const double inside = this->Witnesses[this->Ids[i]].Ask(
        this->Lines[i].At(q), this->Options.FloorPx, verdict.Seen);
      if (inside < verdict.Min)
      {
        verdict.Second = verdict.Min;
        verdict.Min = inside;
        verdict.MinId = static_cast<int>(i);
      }
      else
      {
        verdict.Second = std::min(verdict.Second, inside);
      }
      const double objection = this->Options.WithoutEach ? verdict.Second : verdict.Min;
      if (objection <= residual)
      {
        // Who spoke against this point may well speak against the next.
        this->Asked = i;
        verdict.MinId = -1;
        verdict.Shortfall = residual - objection;
        return verdict;
      }
    }
    return verdict;
  }

  const std::vector<SilhouetteWitness>& Witnesses;
  const HullConsistencyOptions& Options;
  Vector3d Origin;
  Vector3d Direction;
  double Scale = 1; ///< q = 1/2 is so far along the ray
  std::vector<int> Ids;
  std::vector<PictureLine> Lines; ///< in the image of each
  std::size_t Asked = 0;
  double BestAt = 0;
};
}

std::vector<RayConsistency> FollowSilhouetteRays(const std::vector<View>& views,
  const std::vector<SilhouetteRay>& rays, const HullConsistencyOptions& options,
  const Execution& execution)
{
  const std::vector<SilhouetteWitness> witnesses(views.begin(), views.end());
  std::vector<RayConsistency> agreements(rays.size());
  execution.ForEachWith(
    static_cast<std::int64_t>(rays.size()), [&] { return AgreementFollower(witnesses, options); },
    [&](AgreementFollower& follower, std::int64_t i) { agreements[i] = follower.Follow(rays[i]); });
  execution.Report(1);
  return agreements;
}
}
