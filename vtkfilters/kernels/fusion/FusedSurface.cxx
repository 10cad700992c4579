// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion/FusedSurface.h"

#include "core/Error.h"
#include "core/ImageRef.h"
#include "fusion/SparseTsdf.h"
#include "geometry/ViewSelection.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

/** The confidence of each view's depths, less at grazing incidence. */
std::vector<Image<float>> WeightsOf(
  const std::vector<View>& views, double power, const Execution& execution)
{
  std::vector<Image<float>> weights(views.size());
  execution.ForEach(static_cast<std::int64_t>(views.size()),
    [&](std::int64_t i)
    {
      const View& view = views[i];
      const TsdfView map{ {}, view.ContourDistance, view.DepthMap, view.Confidence, &view.Cam };
      weights[i] = Image<float>(view.DepthMap.Width, view.DepthMap.Height);
      for (int y = 0; y < view.DepthMap.Height; ++y)
      {
        for (int x = 0; x < view.DepthMap.Width; ++x)
        {
          if (view.DepthMap(x, y) > 0)
          {
            weights[i](x, y) =
              view.Confidence(x, y) * static_cast<float>(std::pow(map.Incidence(x, y), power));
          }
        }
      }
    });
  return weights;
}

/** Noisy maps vote further from the surface, and carve less. */
FusionOptions FusionFor(double noise)
{
  FusionOptions options;
  options.TruncationPx = std::clamp(1.9 + 4 * noise, 2.5, 6.0);
  options.SurfacePrior = std::clamp(noise * noise, 0.05, 1.0);
  return options;
}

/** The hull's points, and what the depth maps show, every few pixels. */
std::vector<Vector3d> SeedsOf(const std::vector<Vector3d>& hull, const std::vector<View>& views)
{
  constexpr int every = 3; // less than a block
  std::vector<Vector3d> seeds = hull;
  for (const View& view : views)
  {
    for (int y = 0; y < view.DepthMap.Height; y += every)
    {
      for (int x = 0; x < view.DepthMap.Width; x += every)
      {
        if (view.DepthMap(x, y) > 0)
        {
          seeds.push_back(view.Cam.Unproject(Vector2d(x, y), view.DepthMap(x, y)));
        }
      }
    }
  }
  return seeds;
}
}

//------------------------------------------------------------------------------
FusedSurface FuseDepthMaps(const std::vector<Vector3d>& hull, const std::vector<View>& views,
  const FusedSurfaceOptions& options, const Execution& execution)
{
  RequireDepthMaps(views);
  const double footprint = MedianFootprint(views, hull);
  if (footprint <= 0)
  {
    throw Error("depth map fusion", "the hull has no points or lies behind every camera");
  }
  const std::vector<Image<float>> weights = WeightsOf(views, options.GrazingPower, execution);
  std::vector<View> weighted = views;
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    weighted[i].Confidence = weights[i].Ref();
  }
  const TsdfField field(weighted, FusionFor(options.DepthNoise), footprint);
  execution.Report(0.1);
  const double spacing = options.SpacingPx * footprint;
  Eigen::AlignedBox3d bounds = BoundingBox(hull);
  // The hull's points lie within it by a part of their own spacing.
  const Vector3d margin = Vector3d::Constant(4 * footprint);
  bounds = { bounds.min() - margin, bounds.max() + margin };
  SparseTsdf lattice(field, bounds, SeedsOf(hull, views), spacing, execution);
  execution.Report(0.5);
  lattice.Smooth(options.Smoothing, options.SmoothingIterations, execution);
  execution.Report(0.9);
  lattice.MakeManifold(execution);
  FusedSurface surface;
  surface.Mesh = lattice.Surface(execution);
  if (surface.Mesh.Triangles.empty())
  {
    throw Error("depth map fusion", "the depth maps leave nothing of the object");
  }
  if (!options.KeepAllComponents)
  {
    surface.Dropped = KeepLargestComponent(surface.Mesh);
  }
  execution.Report(1);
  return surface;
}
}
