// SPDX-License-Identifier: GPL-3.0-or-later
#include "silhouettes/SilhouetteRays.h"

#include <algorithm>

namespace novelview
{
using Eigen::Vector2d;

namespace
{
/** Every pixel that satisfies a condition, subsampled to about `count`. */
template <class Condition>
std::vector<SilhouetteRay> ThinnedPixels(
  const ImageRef<const float>& distance, int viewId, int count, const Condition& holds)
{
  std::vector<SilhouetteRay> all;
  for (int y = 1; y + 1 < distance.Height; ++y)
  {
    for (int x = 1; x + 1 < distance.Width; ++x)
    {
      if (holds(distance(x, y)))
      {
        all.push_back({ viewId, Vector2d(x, y) });
      }
    }
  }
  const std::size_t wanted = std::min<std::size_t>(all.size(), static_cast<std::size_t>(count));
  std::vector<SilhouetteRay> rays;
  for (std::size_t i = 0; i < wanted; ++i)
  {
    rays.push_back(all[i * all.size() / wanted]);
  }
  return rays;
}
}

std::vector<SilhouetteRay> AreaRays(const std::vector<View>& views, int viewId, int count)
{
  return ThinnedPixels(
    views[viewId].ContourDistance, viewId, count, [](float distance) { return distance > 0; });
}

std::vector<SilhouetteRay> ContourRays(const std::vector<View>& views, int viewId, int count)
{
  const ImageRef<const float>& distance = views[viewId].ContourDistance;
  std::vector<SilhouetteRay> rays =
    ThinnedPixels(distance, viewId, count, [](float inside) { return inside > 0 && inside <= 1; });
  for (SilhouetteRay& ray : rays)
  {
    const int x = static_cast<int>(ray.Pixel.x());
    const int y = static_cast<int>(ray.Pixel.y());
    const Vector2d inwards(
      distance(x + 1, y) - distance(x - 1, y), distance(x, y + 1) - distance(x, y - 1));
    if (inwards.norm() > 0)
    {
      ray.Pixel -= distance(x, y) * inwards.normalized();
    }
  }
  return rays;
}
}
