// SPDX-License-Identifier: GPL-3.0-or-later
#include "silhouettes/SilhouetteField.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
ContourView::ContourView(const View& view)
{
  this->P.leftCols<3>() = view.Cam.K * view.Cam.R;
  this->P.col(3) = view.Cam.K * view.Cam.T;
  this->Focal = view.Cam.FocalLength();
  const double w = std::max(view.Cam.K(0, 2), view.Cam.Width - view.Cam.K(0, 2));
  const double h = std::max(view.Cam.K(1, 2), view.Cam.Height - view.Cam.K(1, 2));
  this->Stretch = std::hypot(1.0, std::hypot(w, h) / this->Focal);
  this->Distance = view.ContourDistance;
}

namespace
{
/** The distance to the nearest of the box's faces (as planes), positive inside. */
double InsideBox(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& x)
{
  return (x - box.min()).cwiseMin(box.max() - x).minCoeff();
}
}

SilhouetteField::SilhouetteField(
  const std::vector<View>& views, const std::optional<Eigen::AlignedBox3d>& bounds)
  : Views(views.begin(), views.end())
  , Bounds(bounds)
{
}

void SilhouetteField::RestrictTo(
  const Eigen::Vector3d& centre, double radius, SilhouetteField& field) const
{
  field.Views.clear();
  field.Bounds = this->Bounds;
  std::vector<double> low; // per view kept, the least it may say in the ball
  double high = std::numeric_limits<double>::infinity(); // f is nowhere more in the ball
  for (const ContourView& view : this->Views)
  {
    const ContourView::Pixel pixel = view.Project(centre);
    if (pixel.Depth <= -radius)
    {
      continue;
    }
    double lowest = -std::numeric_limits<double>::infinity();
    if (pixel.Depth > radius)
    {
      const double radiusPx = view.RadiusPx(radius, pixel.Depth);
      if (pixel.Inside < -radiusPx)
      {
        continue;
      }
      // A length is a distance times a depth: which end of the depths is the extreme one depends
      // on the sign.
      const double distance = view.DistanceAt(pixel);
      const auto length = [&](double px, double depth) { return px * depth / view.Focal; };
      const double nearest = pixel.Depth - radius;
      const double farthest = pixel.Depth + radius;
      lowest = length(distance - radiusPx, distance > radiusPx ? nearest : farthest);
      if (pixel.Inside > radiusPx)
      {
        high =
          std::min(high, length(distance + radiusPx, distance > -radiusPx ? farthest : nearest));
      }
    }
    low.push_back(lowest);
    field.Views.push_back(view);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < low.size(); ++i)
  {
    if (low[i] <= high)
    {
      field.Views[kept++] = field.Views[i];
    }
  }
  field.Views.erase(field.Views.begin() + static_cast<std::ptrdiff_t>(kept), field.Views.end());
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
  for (std::size_t viewId = 0; viewId < this->Views.size(); ++viewId)
  {
    const ContourView& view = this->Views[viewId];
    const ContourView::Pixel pixel = view.Project(x);
    if (pixel.Depth <= 0 || pixel.Inside < 0)
    {
      continue;
    }
    const double length = view.DistanceAt(pixel) * pixel.Depth / view.Focal;
    if (length < least)
    {
      least = length;
      decidingView = static_cast<int>(viewId);
    }
  }
  if (decidingView < 0)
  {
    return -std::numeric_limits<double>::infinity();
  }
  return this->Bounds ? std::min(least, InsideBox(*this->Bounds, x)) : least;
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
  if (this->Bounds)
  {
    const double inside = InsideBox(*this->Bounds, centre);
    if (inside < -radius)
    {
      return Position::Outside;
    }
    mixed = inside < radius;
  }
  for (const ContourView& view : this->Views)
  {
    const ContourView::Pixel pixel = view.Project(centre);
    if (pixel.Depth <= radius)
    {
      mixed = mixed || pixel.Depth > -radius;
      continue;
    }
    const double radiusPx = view.RadiusPx(radius, pixel.Depth);
    if (pixel.Inside < -radiusPx)
    {
      continue;
    }
    seen = true;
    if (pixel.Inside < radiusPx)
    {
      mixed = true;
      continue;
    }
    const double distance = view.DistanceAt(pixel);
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
