// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/FieldEnergy.h"

#include "deformation/NonOutlineDeformation.h"

#include <algorithm>

namespace novelview
{
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
double Squared(double value)
{
  return value * value;
}
}

PointEnergy FieldOutlineEnergy(const Image<float>& contourDistance, const Vector2d& projection)
{
  const double inside = SampleBilinear(contourDistance.Ref(), projection.x(), projection.y());
  PointEnergy energy;
  energy.Photo = Squared(std::min(inside, 0.0));
  energy.Total = energy.Photo;
  return energy;
}

PointEnergy FieldRayEnergy(const RayPoint& point, const Vector3d& axis,
  const std::vector<Vector3d>& neighbours, double alpha, double footprint)
{
  PointEnergy energy;
  energy.Photo = point.Surface ? Squared((*point.Surface - point.Depth) / footprint) : 0;
  energy.Contour = Squared((point.Start - point.Depth) / footprint);
  energy.Smooth = Squared(RaySmoothnessEnergy(point.Position, axis, neighbours, footprint));
  energy.Total = (point.Surface ? energy.Photo : energy.Contour) + alpha * energy.Smooth;
  return energy;
}
}
