// SPDX-License-Identifier: GPL-3.0-or-later
#include "FusedField.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace novelview
{
using Eigen::Vector3d;

FusedField::FusedField(
  const std::vector<View>& views, const FusionOptions& options, double footprint)
  : Options(options)
  , Tau(options.TruncationPx * footprint)
  , Footprint(footprint)
{
  for (const View& view : views)
  {
    Voter voter;
    voter.P.leftCols<3>() = view.Cam.K * view.Cam.R;
    voter.P.col(3) = view.Cam.K * view.Cam.T;
    voter.From = &view;
    this->Voters.push_back(voter);
  }
}

bool FusedField::Vote(const Vector3d& x, double& f, double& w) const
{
  f = 0;
  w = 0;
  for (const Voter& voter : this->Voters)
  {
    const Vector3d p = voter.P.leftCols<3>() * x + voter.P.col(3);
    if (p.z() <= 0)
    {
      continue;
    }
    const View& view = *voter.From;
    const int u = static_cast<int>(std::floor(p.x() / p.z() + 0.5));
    const int v = static_cast<int>(std::floor(p.y() / p.z() + 0.5));
    if (!view.ContourDistance.Contains(u, v))
    {
      continue;
    }
    if (view.ContourDistance(u, v) < 0 &&
      SampleBilinear(view.ContourDistance, p.x() / p.z(), p.y() / p.z()) < 0)
    {
      return false;
    }
    const double depth = view.DepthMap(u, v);
    const double s = depth - p.z();
    if (depth <= 0 || s < -this->Tau)
    {
      continue;
    }
    const double confidence = view.Confidence(u, v);
    f += confidence * std::min(1.0, s / this->Tau);
    w += confidence;
  }
  return true;
}

double FusedField::Value(const Vector3d& x) const
{
  double f;
  double w;
  const double w0 = this->Options.SurfacePrior;
  return this->Vote(x, f, w) ? (f - w0) / (w + w0) : 1.0;
}

FusedField::RayResult FusedField::Walk(
  const Vector3d& origin, const Vector3d& direction, double from, double to, double step) const
{
  RayResult result;
  const double w0 = this->Options.SurfacePrior;
  double inside = 0; // length of the ray inside every silhouette so far
  double previous = from;
  bool previousFree = false;
  for (double t = from; t <= to; t += step)
  {
    double f;
    double w;
    if (!this->Vote(origin + t * direction, f, w))
    {
      previous = t;
      previousFree = true;
      continue;
    }
    inside += step;
    const double wm = this->Options.SilhouettePrior * this->ChordFactor(inside);
    result.Least = std::min(result.Least, (f - wm) / (w + wm));
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
        (this->Value(origin + middle * direction) > 0 ? a : b) = middle;
      }
      result.Surface = 0.5 * (a + b);
    }
    if (result.Least < 0)
    {
      break;
    }
  }
  return result;
}

double FusedField::ChordFactor(double inside) const
{
  // A longer chord of the hull makes it more likely that something of it is object.
  return 1 + 0.25 * std::min(6.0, inside / (50 * this->Footprint));
}

double FusedField::PriorNeeded(const Vector3d& origin, const Vector3d& direction, double from,
  double to, double step, double enough) const
{
  double least = std::numeric_limits<double>::infinity();
  double inside = 0;
  for (double t = from; t <= to && least > enough; t += step)
  {
    double f;
    double w;
    if (this->Vote(origin + t * direction, f, w))
    {
      inside += step;
      least = std::min(least, f / this->ChordFactor(inside));
    }
  }
  return std::max(least, 0.0);
}
}
