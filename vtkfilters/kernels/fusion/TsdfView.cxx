// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion/TsdfView.h"

#include <cmath>
#include <limits>

namespace novelview
{
using Eigen::Vector3d;

double TsdfView::Incidence(int x, int y) const
{
  constexpr int reach = 3;
  const ImageRef<const float>& map = this->DepthMap;
  const double depth = map(x, y);
  // The less steep side: the other may lie across an edge.
  const auto slope = [&](int dx, int dy)
  {
    double least = std::numeric_limits<double>::infinity();
    for (const int side : { -reach, reach })
    {
      const int i = x + side * dx;
      const int j = y + side * dy;
      if (map.Contains(i, j) && map(i, j) > 0)
      {
        least = std::min(least, std::abs(map(i, j) - depth) / reach);
      }
    }
    return std::isfinite(least) ? least / this->Cam->PixelFootprint(depth) : 0.0;
  };
  const double across = slope(1, 0);
  const double down = slope(0, 1);
  return 1 / std::sqrt(1 + across * across + down * down);
}

int TsdfView::StepsWithin(double pixels, const ProjectedSample& sample, const Vector3d& step) const
{
  const ImageRef<const float>& contour = this->ContourDistance;
  const double reach = std::min(
    { pixels, sample.X, sample.Y, contour.Width - 1 - sample.X, contour.Height - 1 - sample.Y });
  if (reach <= 0)
  {
    return 0;
  }
  // After n steps q of homogeneous coordinates the picture has moved by n m / (z + n q.z).
  const Vector3d q = this->P.leftCols<3>() * step;
  const double m = std::hypot(q.x() - sample.X * q.z(), q.y() - sample.Y * q.z());
  const double growth = m - reach * q.z();
  constexpr double most = 1e6;
  return static_cast<int>(
    growth * most > reach * sample.Depth ? reach * sample.Depth / growth : most);
}
}
