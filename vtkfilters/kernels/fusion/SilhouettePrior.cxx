// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion/SilhouettePrior.h"

#include "core/Quantile.h"
#include "core/ToInt.h"
#include "geometry/DepthImage.h"
#include "geometry/ViewSelection.h"
#include "geometry/Visibility.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

/** The priors that sampled pixels of one photograph need to count as object. */
std::vector<double> PriorsOf(const View& key, const TsdfField& field, const TriangleMesh& hull,
  double footprint, const SilhouettePriorOptions& options)
{
  const Image<float> front = RasteriseDepth(hull, key.Cam);
  const double reach = BoundingDiagonal(hull.Points);
  const Vector3d centre = key.Cam.Centre();
  double area = 0;
  for (const float depth : front.Values)
  {
    area += std::isfinite(depth);
  }
  const int step = std::max(1, ToInt(std::sqrt(area / options.PixelsPerKey)));
  std::vector<double> priors;
  for (int y = step / 2; y < front.Height; y += step)
  {
    for (int x = step / 2; x < front.Width; x += step)
    {
      // Right at the contour half of the pixels would be lost by any measure.
      if (std::isfinite(front(x, y)) && key.ContourDistance(x, y) > 1.5)
      {
        const Vector3d direction = key.Cam.Unproject(Vector2d(x, y), 1) - centre;
        const double from = front(x, y) - 1.5 * footprint;
        priors.push_back(
          field.PriorNeeded(centre, direction, from, from + reach, 2 * footprint, options.Min));
      }
    }
  }
  return priors;
}
}

double FindSilhouettePrior(const std::vector<View>& views, const TriangleMesh& hull,
  const SilhouettePriorOptions& options, const Execution& execution)
{
  const double footprint = MedianFootprint(views, hull.Points);
  if (footprint <= 0)
  {
    return options.Min;
  }
  const int keys = std::min(options.Keys, static_cast<int>(views.size()));
  std::vector<std::vector<double>> perKey(keys);
  execution.ForEach(keys,
    [&](std::int64_t i)
    {
      const std::size_t key = i * views.size() / keys;
      std::vector<View> others = views;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(key));
      const TsdfField field(others, options.Fusion, footprint);
      perKey[i] = PriorsOf(views[key], field, hull, footprint, options);
    });
  std::vector<double> all;
  for (const auto& part : perKey)
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  if (all.empty())
  {
    return options.Min;
  }
  const double needed = std::max(Quantile(std::move(all), 1 - options.AcceptedLoss), options.Min);
  const double noise = std::max(options.Noise, 1.0);
  // Votes of maps whose deviations leave the truncation band fall on either side by chance.
  const double beyond = std::max(2 * options.Noise / options.Fusion.TruncationPx, 1.0);
  return std::min(
    options.Min * beyond * beyond + (needed - options.Min) * noise * noise, options.Max);
}
}
