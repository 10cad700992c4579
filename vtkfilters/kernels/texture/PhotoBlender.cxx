// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/PhotoBlender.h"

#include "geometry/DepthImage.h"

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
      Eigen::Matrix<double, 3, 4> P;
      P << view.Cam.K * view.Cam.R, view.Cam.K * view.Cam.T;
      references.push_back({ &view, view.Cam.Centre(), P, view.Cam.FocalLength(), {},
        hasDepth ? view.DepthMap : ImageRef<const float>() });
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
  const double behind = OcclusionDepth(reference.Depth, u, z) * reference.FocalLength / z;
  if (options.OcclusionPx <= 0)
  {
    return behind <= 1.5 ? 1 : 0;
  }
  const double ratio = behind / options.OcclusionPx;
  return behind <= 0 ? 1 : std::exp(-ratio * ratio);
}

/** Where a point inside the frame lies between four pixels: that of SampleBilinear(). */
struct BilinearCell
{
  int X;
  int Y;
  int Right; ///< 0 at the last column, else 1
  int Below;
  double Fx;
  double Fy;

  BilinearCell(const Vector2d& u, int width, int height)
    : X(std::min(static_cast<int>(u.x()), std::max(width - 2, 0)))
    , Y(std::min(static_cast<int>(u.y()), std::max(height - 2, 0)))
    , Right(this->X + 1 < width)
    , Below(this->Y + 1 < height)
    , Fx(u.x() - this->X)
    , Fy(u.y() - this->Y)
  {
  }

  template <class T>
  void Sample(const ImageRef<T>& image, int channels, double* values) const
  {
    const T* top = image.Pixel(this->X, this->Y);
    const T* bottom = top + this->Below * image.RowStride;
    const int right = this->Right * channels;
    for (int channel = 0; channel < channels; ++channel)
    {
      const double above = top[channel] * (1 - this->Fx) + top[channel + right] * this->Fx;
      const double below = bottom[channel] * (1 - this->Fx) + bottom[channel + right] * this->Fx;
      values[channel] = above * (1 - this->Fy) + below * this->Fy;
    }
  }
};
}

double BlendShare(const BlendReference& reference, const Vector3d& point,
  const TextureOptions& options, Vector2d& pixel)
{
  const Camera& camera = reference.Photo->Cam;
  const Vector3d p = reference.P * point.homogeneous();
  const double z = p.z();
  if (z <= 0)
  {
    return 0;
  }
  pixel = p.hnormalized();
  if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= camera.Width - 1 &&
        pixel.y() <= camera.Height - 1))
  {
    return 0;
  }
  double inside = 0;
  BilinearCell(pixel, camera.Width, camera.Height)
    .Sample(reference.Photo->ContourDistance, 1, &inside);
  inside -= options.BorderPx;
  if (inside <= 0)
  {
    return 0;
  }
  const double whole = inside < options.FeatherPx ? inside / options.FeatherPx : 1;
  return whole * Visibility(reference, pixel, z, options);
}

namespace
{
/** std::pow(), many times faster for the whole powers that are usual. */
double PowerOf(double base, double power)
{
  int left = static_cast<int>(power);
  if (left != power || left < 0)
  {
    return std::pow(base, power);
  }
  double result = 1;
  for (; left; left >>= 1, base *= base)
  {
    result *= left & 1 ? base : 1;
  }
  return result;
}
}

bool PhotoBlender::Blend(
  const Vector3d& point, const Vector3d& ray, double rgb[3], double maxCosine)
{
  this->SortByAngle(point, ray);
  double total = 0;
  int used = 0;
  rgb[0] = rgb[1] = rgb[2] = 0;
  this->Cosine = 0;
  for (const auto& [cosine, reference] : this->Nearest)
  {
    if (cosine <= 0 || used == this->Options.References)
    {
      break;
    }
    if (maxCosine < 1 && cosine > maxCosine)
    {
      continue;
    }
    Vector2d u;
    const double share = BlendShare(*reference, point, this->Options, u);
    const double weight = share > 0 ? share * PowerOf(cosine, this->Options.Power) : 0;
    if (weight <= 1e-6)
    {
      continue;
    }
    const double gain = this->Options.UseGains ? reference->Photo->Gain : 1;
    total += weight;
    this->Cosine += weight * cosine;
    double color[3];
    const ImageRef<const std::uint8_t>& photo = reference->Photo->Color;
    BilinearCell(u, photo.Width, photo.Height).Sample(photo, 3, color);
    for (int channel = 0; channel < 3; ++channel)
    {
      rgb[channel] += weight / gain * color[channel];
    }
    ++used;
  }
  for (int channel = 0; channel < 3 && total > 0; ++channel)
  {
    rgb[channel] /= total;
  }
  this->Cosine = total > 0 ? this->Cosine / total : 0;
  return total > 0;
}

void PhotoBlender::SortByAngle(const Vector3d& point, const Vector3d& ray)
{
  for (auto& [cosine, reference] : this->Nearest)
  {
    const Vector3d own = point - reference->Centre;
    const double distance = own.norm();
    cosine = distance > 0 ? ray.dot(own) / distance : 0;
  }
  // In the order of the point before there is next to nothing to swap.
  const auto comesBefore = [](const auto& a, const auto& b)
  { return a.first > b.first || (a.first == b.first && a.second < b.second); };
  for (std::size_t end = 1; end < this->Nearest.size(); ++end)
  {
    for (std::size_t i = end; i > 0 && comesBefore(this->Nearest[i], this->Nearest[i - 1]); --i)
    {
      std::swap(this->Nearest[i], this->Nearest[i - 1]);
    }
  }
}
}
