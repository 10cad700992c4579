// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_RayMarcher_h
#define novelview_RayMarcher_h

#include "fusion/TsdfField.h"
#include "geometry/Camera.h"

#include <algorithm>

namespace novelview
{
/** Follows the rays of a novel camera through a fused field; parameters are depths in the camera. */
class RayMarcher
{
public:
  /** @param reach how far rays are followed at most; @param step between samples; world units. */
  RayMarcher(const TsdfField& field, const Camera& novel, double reach, double step)
    : Field(field)
    , Novel(novel)
    , Centre(novel.Centre())
    , Reach(reach)
    , Step(step)
  {
  }

  TsdfField::RayResult FindFirstCrossing(const Eigen::Vector2d& pixel, double frontDepth) const
  {
    return this->Field.FindFirstCrossing(this->Centre, this->Direction(pixel),
      this->From(frontDepth), frontDepth + this->Reach, this->Step);
  }

  TsdfField::ClosestApproach FindClosestApproach(
    const Eigen::Vector2d& pixel, double frontDepth) const
  {
    return this->Field.FindClosestApproach(this->Centre, this->Direction(pixel),
      this->From(frontDepth), frontDepth + this->Reach, this->Step);
  }

private:
  Eigen::Vector3d Direction(const Eigen::Vector2d& pixel) const
  {
    return this->Novel.Unproject(pixel, 1) - this->Centre;
  }
  double From(double frontDepth) const { return std::max(frontDepth, this->Step); }

  const TsdfField& Field;
  const Camera& Novel;
  const Eigen::Vector3d Centre;
  const double Reach;
  const double Step;
};
}

#endif
