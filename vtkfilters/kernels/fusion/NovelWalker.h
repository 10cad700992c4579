// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_NovelWalker_h
#define novelview_NovelWalker_h

#include "fusion/FusedField.h"
#include "geometry/Camera.h"

#include <algorithm>

namespace novelview
{
/** Follows the rays of a novel camera through a fused field; parameters are depths in the camera. */
class NovelWalker
{
public:
  /** @param reach how far rays are followed at most; @param step between samples; world units. */
  NovelWalker(const FusedField& field, const Camera& novel, double reach, double step)
    : Field(field)
    , Novel(novel)
    , Centre(novel.Centre())
    , Reach(reach)
    , Step(step)
  {
  }

  FusedField::RayResult Walk(const Eigen::Vector2d& pixel, double frontDepth) const
  {
    return this->Field.Walk(this->Centre, this->Direction(pixel), this->From(frontDepth),
      frontDepth + this->Reach, this->Step);
  }

  FusedField::Passage Pass(const Eigen::Vector2d& pixel, double frontDepth) const
  {
    return this->Field.Pass(this->Centre, this->Direction(pixel), this->From(frontDepth),
      frontDepth + this->Reach, this->Step);
  }

private:
  Eigen::Vector3d Direction(const Eigen::Vector2d& pixel) const
  {
    return this->Novel.Unproject(pixel, 1) - this->Centre;
  }
  double From(double frontDepth) const { return std::max(frontDepth, this->Step); }

  const FusedField& Field;
  const Camera& Novel;
  const Eigen::Vector3d Centre;
  const double Reach;
  const double Step;
};
}

#endif
