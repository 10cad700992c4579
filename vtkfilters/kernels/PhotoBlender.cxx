// SPDX-License-Identifier: GPL-3.0-or-later
#include "PhotoBlender.h"

#include "Rasteriser.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
using Eigen::Vector2d;
using Eigen::Vector3d;

std::vector<BlendReference> MakeBlendReferences(const TriangleMesh& scene,
  const std::vector<View>& views, const Vector3d* axis, const TextureOptions& options,
  const Execution& execution)
{
  std::vector<BlendReference> references;
  for (const View& view : views)
  {
    if (!axis || view.Cam.OpticalAxis().dot(*axis) > 0)
    {
      const bool hasDepth = options.UseDepthMaps && !view.DepthMap.Empty();
      references.push_back(
        { &view, view.Cam.Centre(), {}, hasDepth ? view.DepthMap : ImageRef<const float>() });
    }
  }
  execution.ForEach(static_cast<std::int64_t>(references.size()),
    [&](std::int64_t i)
    {
      BlendReference& reference = references[i];
      if (reference.Depth.Empty())
      {
        reference.ModelDepth = RasteriseDepth(scene, reference.Photo->Cam);
        reference.Depth = static_cast<const Image<float>&>(reference.ModelDepth).Ref();
      }
    });
  return references;
}

namespace
{
/** How visible a point at depth z that projects to u is in a reference: 0 to 1. */
double Visibility(
  const BlendReference& reference, const Vector2d& u, double z, const TextureOptions& options)
{
  const double behind = DepthBehind(reference.Depth, u, z) / reference.Photo->Cam.PixelFootprint(z);
  if (options.OcclusionPx <= 0)
  {
    return behind <= 1.5 ? 1 : 0;
  }
  const double ratio = std::max(behind, 0.0) / options.OcclusionPx;
  return std::exp(-ratio * ratio);
}

/** SampleBilinear() of three channels, inside the frame. */
void SampleColor(const ImageRef<const std::uint8_t>& image, const Vector2d& u, double color[3])
{
  const int x = std::min(static_cast<int>(u.x()), std::max(image.Width - 2, 0));
  const int y = std::min(static_cast<int>(u.y()), std::max(image.Height - 2, 0));
  const double fx = u.x() - x;
  const double fy = u.y() - y;
  const std::uint8_t* top = image.Pixel(x, y);
  const std::uint8_t* bottom = image.Pixel(x, std::min(y + 1, image.Height - 1));
  const int right = x + 1 < image.Width ? 3 : 0;
  for (int channel = 0; channel < 3; ++channel)
  {
    const double above = top[channel] * (1 - fx) + top[channel + right] * fx;
    const double below = bottom[channel] * (1 - fx) + bottom[channel + right] * fx;
    color[channel] = above * (1 - fy) + below * fy;
  }
}
}

double BlendShare(const BlendReference& reference, const Vector3d& point,
  const TextureOptions& options, Vector2d& pixel)
{
  const Camera& camera = reference.Photo->Cam;
  const double z = camera.Depth(point);
  if (z <= 0)
  {
    return 0;
  }
  pixel = camera.Project(point);
  if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= camera.Width - 1 &&
        pixel.y() <= camera.Height - 1))
  {
    return 0;
  }
  const double inside =
    SampleBilinear(reference.Photo->ContourDistance, pixel.x(), pixel.y()) - options.BorderPx;
  return inside <= 0
    ? 0
    : std::min(inside / options.FeatherPx, 1.0) * Visibility(reference, pixel, z, options);
}

bool PhotoBlender::Blend(const Vector3d& point, const Vector3d& ray, double rgb[3])
{
  this->SortByAngle(point, ray);
  double total = 0;
  int used = 0;
  rgb[0] = rgb[1] = rgb[2] = 0;
  for (const auto& [cosine, reference] : this->Nearest)
  {
    Vector2d u;
    const double share = BlendShare(*reference, point, this->Options, u);
    const double weight = share > 0 ? share * std::pow(cosine, this->Options.Power) : 0;
    if (weight <= 1e-6)
    {
      continue;
    }
    const double gain = this->Options.UseGains ? reference->Photo->Gain : 1;
    total += weight;
    double color[3];
    SampleColor(reference->Photo->Color, u, color);
    for (int channel = 0; channel < 3; ++channel)
    {
      rgb[channel] += weight / gain * color[channel];
    }
    if (++used == this->Options.References)
    {
      break;
    }
  }
  for (int channel = 0; channel < 3 && total > 0; ++channel)
  {
    rgb[channel] /= total;
  }
  return total > 0;
}

/** Those that look at the point from the ray's side, the nearest first. */
void PhotoBlender::SortByAngle(const Vector3d& point, const Vector3d& ray)
{
  this->Nearest.clear();
  for (const BlendReference& reference : this->References)
  {
    const Vector3d own = point - reference.Centre;
    const double cosine = ray.dot(own) / own.norm();
    if (cosine > 0)
    {
      this->Nearest.emplace_back(cosine, &reference);
    }
  }
  std::sort(this->Nearest.begin(), this->Nearest.end(),
    [](const auto& a, const auto& b) { return a.first > b.first; });
}
}
