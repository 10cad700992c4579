// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion/TsdfRay.h"

#include "core/FunctionMultiversioning.h"

#include <algorithm>

namespace novelview
{
using Eigen::Vector3d;

namespace
{
/**
 * The numbers of a TsdfRay, an array over all views each: homogeneous coordinates of its origin and
 * of its direction, and where the views see a point of it.
 */
struct RayArrays
{
  const double *OriginX, *OriginY, *OriginZ;
  const double *DirectionX, *DirectionY, *DirectionZ;
  double *X, *Y, *Z;
  int *Column, *Row;
};

/** Projects the point at parameter t. Column and row are -1 before the first or behind a camera. */
NOVELVIEW_CLONES void ProjectPoint(const RayArrays& ray, double t, int count)
{
  constexpr double most = 1 << 24; // beyond every frame
  for (int i = 0; i < count; ++i)
  {
    const double z = ray.OriginZ[i] + t * ray.DirectionZ[i];
    const double x = (ray.OriginX[i] + t * ray.DirectionX[i]) / z;
    const double y = (ray.OriginY[i] + t * ray.DirectionY[i]) / z;
    ray.X[i] = x;
    ray.Y[i] = y;
    ray.Z[i] = z;
    // Rounded to the nearest; nothing below 0 comes before the conversion, which cuts off.
    const double column = z > 0 && x > -1 ? std::min(x, most) + 1.5 : 0;
    const double row = z > 0 && y > -1 ? std::min(y, most) + 1.5 : 0;
    ray.Column[i] = static_cast<int>(column) - 1;
    ray.Row[i] = static_cast<int>(row) - 1;
  }
}
}

TsdfRay::TsdfRay(
  const std::vector<TsdfView>& views, const Vector3d& origin, const Vector3d& direction)
  : Count(static_cast<int>(views.size()))
  , Numbers(9 * views.size())
  , Pixels(2 * views.size())
{
  for (int i = 0; i < this->Count; ++i)
  {
    const Vector3d o = views[i].P.leftCols<3>() * origin + views[i].P.col(3);
    const Vector3d d = views[i].P.leftCols<3>() * direction;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Array(axis)[i] = o[axis];
      this->Array(3 + axis)[i] = d[axis];
    }
  }
}

void TsdfRay::MoveTo(double t)
{
  ProjectPoint({ this->Array(0), this->Array(1), this->Array(2), this->Array(3), this->Array(4),
                 this->Array(5), this->Array(6), this->Array(7), this->Array(8),
                 this->Pixels.data(), this->Pixels.data() + this->Count },
    t, this->Count);
}
}
