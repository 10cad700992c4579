// SPDX-License-Identifier: GPL-3.0-or-later
#include "SilhouetteField.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
/** Distance (px) of a pixel position to the frame's border, positive inside. */
double DistanceToFrame(const ImageRef<const float>& image, double x, double y)
{
  return std::min({ x + 0.5, y + 0.5, image.Width - 0.5 - x, image.Height - 0.5 - y });
}
}

SilhouetteField::SilhouetteField(const std::vector<View>& views)
{
  this->Projectors.reserve(views.size());
  for (const View& view : views)
  {
    Projector projector;
    projector.P.leftCols<3>() = view.Cam.K * view.Cam.R;
    projector.P.col(3) = view.Cam.K * view.Cam.T;
    projector.Focal = view.Cam.FocalLength();
    const double w = std::max(view.Cam.K(0, 2), view.Cam.Width - view.Cam.K(0, 2));
    const double h = std::max(view.Cam.K(1, 2), view.Cam.Height - view.Cam.K(1, 2));
    projector.Stretch = std::hypot(1.0, std::hypot(w, h) / projector.Focal);
    projector.Distance = view.ContourDistance;
    this->Projectors.push_back(projector);
  }
}

double SilhouetteField::Value(const Eigen::Vector3d& x) const
{
  int ignored;
  return this->Value(x, ignored);
}

double SilhouetteField::Value(const Eigen::Vector3d& x, int& decidingView) const
{
  double least = std::numeric_limits<double>::infinity();
  decidingView = -1;
  for (std::size_t viewId = 0; viewId < this->Projectors.size(); ++viewId)
  {
    const Projector& view = this->Projectors[viewId];
    const Eigen::Vector3d p = view.P.leftCols<3>() * x + view.P.col(3);
    if (p.z() <= 0)
    {
      continue;
    }
    const double u = p.x() / p.z();
    const double v = p.y() / p.z();
    if (DistanceToFrame(view.Distance, u, v) < 0)
    {
      continue;
    }
    const double length = SampleBilinear(view.Distance, u, v) * p.z() / view.Focal;
    if (length < least)
    {
      least = length;
      decidingView = static_cast<int>(viewId);
    }
  }
  return decidingView < 0 ? -std::numeric_limits<double>::infinity() : least;
}

Eigen::Vector3d SilhouetteField::Gradient(const Eigen::Vector3d& x, double step) const
{
  Eigen::Vector3d gradient;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d offset = step * Eigen::Vector3d::Unit(axis);
    gradient[axis] = (this->Value(x + offset) - this->Value(x - offset)) / (2 * step);
  }
  return gradient.allFinite() ? gradient : Eigen::Vector3d::Zero();
}

SilhouetteField::Position SilhouetteField::Classify(
  const Eigen::Vector3d& centre, double radius) const
{
  bool seen = false;
  bool mixed = false;
  for (const Projector& view : this->Projectors)
  {
    const Eigen::Vector3d p = view.P.leftCols<3>() * centre + view.P.col(3);
    if (p.z() <= radius)
    {
      mixed = mixed || p.z() > -radius;
      continue;
    }
    // One pixel more than the ball's own, for what bilinear sampling may be off by.
    const double radiusPx = view.Stretch * radius * view.Focal / (p.z() - radius) + 1;
    const double u = p.x() / p.z();
    const double v = p.y() / p.z();
    const double toFrame = DistanceToFrame(view.Distance, u, v);
    if (toFrame < -radiusPx)
    {
      continue;
    }
    seen = true;
    if (toFrame < radiusPx)
    {
      mixed = true;
      continue;
    }
    const double distance = SampleBilinear(view.Distance, u, v);
    if (distance < -radiusPx)
    {
      return Position::Outside;
    }
    mixed = mixed || distance < radiusPx;
  }
  if (mixed)
  {
    return Position::Mixed;
  }
  return seen ? Position::Inside : Position::Outside;
}
}
