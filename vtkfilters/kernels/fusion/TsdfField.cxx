// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion/TsdfField.h"

#include "fusion/TsdfRay.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace novelview
{
using Eigen::Vector3d;

namespace
{
/** Extends a box by the surface that a view's depth map shows, every fourth pixel. */
void ExtendByMap(const View& view, Eigen::AlignedBox3d& box)
{
  constexpr int every = 4;
  for (int y = 0; y < view.DepthMap.Height; y += every)
  {
    for (int x = 0; x < view.DepthMap.Width; x += every)
    {
      if (view.DepthMap(x, y) > 0)
      {
        box.extend(view.Cam.Unproject(Eigen::Vector2d(x, y), view.DepthMap(x, y)));
      }
    }
  }
}

/** Value at the middle of the parabola fitted to five evenly spaced values, the ends repeated. */
double ParabolaAt(const std::vector<double>& values, int k)
{
  const int last = static_cast<int>(values.size()) - 1;
  const auto at = [&](int i) { return values[std::clamp(i, 0, last)]; };
  return (17 * at(k) + 12 * (at(k - 1) + at(k + 1)) - 3 * (at(k - 2) + at(k + 2))) / 35;
}
}

TsdfField::TsdfField(const std::vector<View>& views, const FusionOptions& options, double footprint)
  : Options(options)
  , Tau(options.TruncationPx * footprint)
  , Footprint(footprint)
{
  for (const View& view : views)
  {
    Eigen::Matrix<double, 3, 4> projection;
    projection.leftCols<3>() = view.Cam.K * view.Cam.R;
    projection.col(3) = view.Cam.K * view.Cam.T;
    this->Views.push_back(
      { projection, view.ContourDistance, view.DepthMap, view.Confidence, &view.Cam });
    ExtendByMap(view, this->Bounds);
  }
  if (!this->Bounds.isEmpty())
  {
    const Vector3d margin = Vector3d::Constant(this->Tau + 4 * footprint);
    this->Bounds = { this->Bounds.min() - margin, this->Bounds.max() + margin };
  }
}

TsdfField TsdfField::Of(const std::vector<int>& views) const
{
  TsdfField part = *this;
  part.Views.clear();
  for (const int view : views)
  {
    part.Views.push_back(this->Views[view]);
  }
  return part;
}

void TsdfField::ClipToBounds(
  const Vector3d& origin, const Vector3d& direction, double& from, double& to) const
{
  for (int axis = 0; axis < 3 && !this->Bounds.isEmpty(); ++axis)
  {
    if (direction[axis] != 0)
    {
      const double a = (this->Bounds.min()[axis] - origin[axis]) / direction[axis];
      const double b = (this->Bounds.max()[axis] - origin[axis]) / direction[axis];
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
    else if (origin[axis] < this->Bounds.min()[axis] || origin[axis] > this->Bounds.max()[axis])
    {
      to = -std::numeric_limits<double>::infinity();
    }
  }
}

bool TsdfField::Accumulate(const Vector3d& x, double& f, double& w) const
{
  TsdfRay ray(this->Views, x, Vector3d::Zero());
  ray.MoveTo(0);
  return this->Accumulate(ray, f, w);
}

bool TsdfField::Accumulate(const TsdfRay& ray, double& f, double& w) const
{
  f = 0;
  w = 0;
  ProjectedSample sample;
  for (int i = 0; i < static_cast<int>(this->Views.size()); ++i)
  {
    const TsdfView& view = this->Views[i];
    if (!ray.See(i, view, sample))
    {
      continue;
    }
    const ImageRef<const float>& contour = view.ContourDistance;
    if (contour(sample.Column, sample.Row) < 0 && SampleBilinear(contour, sample.X, sample.Y) < 0)
    {
      return false;
    }
    view.Accumulate(sample, this->Tau, 0, f, w);
  }
  return true;
}

double TsdfField::Value(const TsdfRay& ray) const
{
  double f;
  double w;
  const double w0 = this->Options.SurfacePrior;
  return this->Accumulate(ray, f, w) ? (f - w0) / (w + w0) : 1.0;
}

TsdfField::RayResult TsdfField::FindFirstCrossing(
  const Vector3d& origin, const Vector3d& direction, double from, double to, double step) const
{
  RayResult result;
  this->ClipToBounds(origin, direction, from, to);
  const double w0 = this->Options.SurfacePrior;
  TsdfRay ray(this->Views, origin, direction);
  double inside = 0; // length of the ray inside every silhouette so far
  double previous = from;
  bool previousFree = false;
  for (double t = from; t <= to; t += step)
  {
    double f;
    double w;
    ray.MoveTo(t);
    if (!this->Accumulate(ray, f, w))
    {
      previous = t;
      previousFree = true;
      continue;
    }
    inside += step;
    const double wm = this->Options.SilhouettePrior * this->ChordFactor(inside);
    result.Min = std::min(result.Min, (f - wm) / (w + wm));
    const double value = (f - w0) / (w + w0);
    if (value > 0)
    {
      previous = t;
      previousFree = true;
      continue;
    }
    if (!result.Surface)
    {
      double a = previousFree ? previous : t;
      double b = t;
      for (int halving = 0; halving < 6 && previousFree; ++halving)
      {
        const double middle = 0.5 * (a + b);
        ray.MoveTo(middle);
        (this->Value(ray) > 0 ? a : b) = middle;
      }
      result.Surface = 0.5 * (a + b);
    }
    if (result.Min < 0)
    {
      break;
    }
  }
  return result;
}

TsdfField::Sample TsdfField::SampleAt(const TsdfRay& ray, const Vector3d& step) const
{
  const double tau = this->Options.TruncationPx;
  constexpr double nearest = 0.75; // pixels from a point to the nearest pixel's centre, at most
  Sample sample{ -tau, 0, 0, 0 };
  ProjectedSample projected;
  for (int i = 0; i < static_cast<int>(this->Views.size()); ++i)
  {
    const TsdfView& view = this->Views[i];
    if (!ray.See(i, view, projected))
    {
      continue;
    }
    const ImageRef<const float>& contour = view.ContourDistance;
    const double outside = -contour(projected.Column, projected.Row);
    if (outside >= tau + nearest)
    {
      return { tau, 0, 0, view.StepsWithin(outside - nearest - tau, projected, step) };
    }
    // Interpolated only where the nearest pixel says that it can matter.
    if (outside > sample.Outside - 2)
    {
      sample.Outside = std::max(sample.Outside, -SampleBilinear(contour, projected.X, projected.Y));
    }
    view.Accumulate(projected, this->Tau, this->Options.GrazingDiscount, sample.F, sample.W);
  }
  sample.Outside = std::min(sample.Outside, tau);
  return sample;
}

void TsdfField::SampleRow(
  const Vector3d& origin, const Vector3d& step, int count, LatticeSample* samples) const
{
  const double tau = this->Options.TruncationPx;
  const double w0 = this->Options.SurfacePrior;
  TsdfRay ray(this->Views, origin, step);
  for (int n = 0; n < count; ++n)
  {
    ray.MoveTo(n);
    LatticeSample& sample = samples[n];
    double outside =
      this->Bounds.isEmpty() || this->Bounds.contains(origin + n * step) ? -tau : tau;
    double f = -w0 * tau;
    double w = w0;
    ProjectedSample projected;
    for (int i = 0; i < static_cast<int>(this->Views.size()) && outside < tau; ++i)
    {
      const TsdfView& view = this->Views[i];
      if (ray.See(i, view, projected))
      {
        outside =
          std::max(outside, -SampleBilinear(view.ContourDistance, projected.X, projected.Y));
        view.AccumulateTapered(projected, this->Tau, tau, f, w);
      }
    }
    sample.Outside = static_cast<float>(std::min(outside, tau));
    sample.Weight = static_cast<float>(w);
    sample.Distance = outside >= tau ? sample.Outside : static_cast<float>(f / w);
  }
}

TsdfField::ClosestApproach TsdfField::FindClosestApproach(
  const Vector3d& origin, const Vector3d& direction, double from, double to, double step) const
{
  this->ClipToBounds(origin, direction, from, to);
  const double tau = this->Options.TruncationPx;
  ClosestApproach approach{ tau, from };
  if (from > to)
  {
    return approach;
  }
  const std::size_t count = 1 + static_cast<std::size_t>((to - from) / step);
  std::vector<double> outside(count, tau);
  std::vector<double> field(count, tau);
  TsdfRay ray(this->Views, origin, direction);
  double inside = 0;
  for (std::size_t k = 0; k < count; ++k)
  {
    ray.MoveTo(from + k * step);
    const Sample sample = this->SampleAt(ray, step * direction);
    if (sample.Outside >= tau)
    {
      k += sample.FreeSteps;
      continue;
    }
    inside += sample.Outside < 0 ? step : 0;
    const double wm = this->Options.SilhouettePrior * this->ChordFactor(inside);
    const bool unseen = sample.W + wm <= 0;
    outside[k] = sample.Outside;
    field[k] = unseen ? -tau : tau * (sample.F - wm) / (sample.W + wm);
  }
  for (int k = 0; k < static_cast<int>(count); ++k)
  {
    if (outside[k] >= approach.SignedDistance)
    {
      continue;
    }
    const double value = std::max(outside[k], std::clamp(ParabolaAt(field, k), -tau, tau));
    if (value < approach.SignedDistance)
    {
      approach = { value, from + k * step };
    }
  }
  return approach;
}

double TsdfField::ChordFactor(double inside) const
{
  // A longer chord of the hull makes it more likely that something of it is object.
  return 1 + 0.25 * std::min(6.0, inside / (50 * this->Footprint));
}

double TsdfField::PriorNeeded(const Vector3d& origin, const Vector3d& direction, double from,
  double to, double step, double enough) const
{
  this->ClipToBounds(origin, direction, from, to);
  TsdfRay ray(this->Views, origin, direction);
  double least = std::numeric_limits<double>::infinity();
  double inside = 0;
  for (double t = from; t <= to && least > enough; t += step)
  {
    double f;
    double w;
    ray.MoveTo(t);
    if (this->Accumulate(ray, f, w))
    {
      inside += step;
      least = std::min(least, f / this->ChordFactor(inside));
    }
  }
  return std::max(least, 0.0);
}
}
