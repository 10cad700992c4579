// SPDX-License-Identifier: GPL-3.0-or-later
#include "TextureMapping.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr float NoDepth = std::numeric_limits<float>::infinity();

/** A reference photograph and what it sees of the model. */
struct Reference
{
  const View* Photo;
  Vector3d Centre;
  Image<float> ModelDepth;     ///< empty when the photograph's own depth map is used
  ImageRef<const float> Depth; ///< 0 or infinity = nothing there
};

std::vector<Reference> MakeReferences(const TriangleMesh& mesh, const TriangleMesh* occluders,
  const std::vector<View>& views, const Camera& camera, const TextureOptions& options,
  const Execution& execution)
{
  TriangleMesh scene = mesh;
  if (occluders)
  {
    const Eigen::Vector3i shift = Eigen::Vector3i::Constant(static_cast<int>(mesh.Points.size()));
    scene.Points.insert(scene.Points.end(), occluders->Points.begin(), occluders->Points.end());
    for (const Eigen::Vector3i& t : occluders->Triangles)
    {
      scene.Triangles.push_back(t + shift);
    }
  }
  std::vector<Reference> references;
  references.reserve(views.size());
  for (const View& view : views)
  {
    // More than a right angle off, a photograph shows the other side.
    if (view.Cam.OpticalAxis().dot(camera.OpticalAxis()) <= 0)
    {
      continue;
    }
    Reference& reference = references.emplace_back();
    reference.Photo = &view;
    reference.Centre = view.Cam.Centre();
    if (options.UseDepthMaps && !view.DepthMap.Empty())
    {
      reference.Depth = view.DepthMap;
    }
    else
    {
      reference.ModelDepth = Rasterise(scene, view.Cam, execution).Depth;
      reference.Depth = static_cast<const Image<float>&>(reference.ModelDepth).Ref();
    }
  }
  return references;
}

/** How visible a point at depth z that projects to u is in a reference: 0 to 1. */
double Visibility(
  const Reference& reference, const Vector2d& u, double z, const TextureOptions& options)
{
  const double behind = DepthBehind(reference.Depth, u, z) / reference.Photo->Cam.PixelFootprint(z);
  if (options.OcclusionPx <= 0)
  {
    return behind <= 1.5 ? 1 : 0;
  }
  const double ratio = std::max(behind, 0.0) / options.OcclusionPx;
  return std::exp(-ratio * ratio);
}

struct Candidate
{
  double Cosine;
  double Weight;
  const Reference* From;
  Vector2d Pixel;
};

/** Everything the colour of one pixel needs; one per thread, so that no pixel allocates. */
class Blender
{
public:
  Blender(
    const std::vector<Reference>& references, const Camera& camera, const TextureOptions& options)
    : References(references)
    , Centre(camera.Centre())
    , Options(options)
  {
  }

  /** Blends the colour of a surface point; false when no reference sees it. */
  bool Blend(const Vector3d& point, double rgb[3])
  {
    this->Collect(point);
    std::sort(this->Candidates.begin(), this->Candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.Cosine > b.Cosine; });
    if (this->Candidates.size() > static_cast<std::size_t>(this->Options.References))
    {
      this->Candidates.resize(this->Options.References);
    }
    double total = 0;
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (const Candidate& candidate : this->Candidates)
    {
      const double gain = this->Options.UseGains ? candidate.From->Photo->Gain : 1;
      total += candidate.Weight;
      for (int channel = 0; channel < 3; ++channel)
      {
        rgb[channel] += candidate.Weight / gain *
          SampleBilinear(
            candidate.From->Photo->Color, candidate.Pixel.x(), candidate.Pixel.y(), channel);
      }
    }
    for (int channel = 0; channel < 3 && total > 0; ++channel)
    {
      rgb[channel] /= total;
    }
    return total > 0;
  }

private:
  void Collect(const Vector3d& point)
  {
    this->Candidates.clear();
    const Vector3d novelRay = (point - this->Centre).normalized();
    for (const Reference& reference : this->References)
    {
      const Camera& camera = reference.Photo->Cam;
      const double z = camera.Depth(point);
      const double cosine = novelRay.dot((point - reference.Centre).normalized());
      if (z <= 0 || cosine <= 0)
      {
        continue;
      }
      const Vector2d u = camera.Project(point);
      if (u.x() < 0 || u.y() < 0 || u.x() > camera.Width - 1 || u.y() > camera.Height - 1)
      {
        continue;
      }
      const double inside =
        SampleBilinear(reference.Photo->ContourDistance, u.x(), u.y()) - this->Options.BorderPx;
      if (inside <= 0)
      {
        continue;
      }
      const double weight = std::pow(cosine, this->Options.Power) *
        std::min(inside / this->Options.FeatherPx, 1.0) *
        Visibility(reference, u, z, this->Options);
      if (weight > 1e-6)
      {
        this->Candidates.push_back({ cosine, weight, &reference, u });
      }
    }
  }

  const std::vector<Reference>& References;
  const Vector3d Centre;
  const TextureOptions& Options;
  std::vector<Candidate> Candidates;
};

/**
 * Item buffer at pixel resolution with the share of each pixel that the mesh covers. A pixel whose
 * centre is missed but of which half is covered takes the hit sub-ray nearest the centre.
 */
struct CoveredBuffer
{
  Image<int> CellId;
  Image<float> Depth;
  Image<float> Coverage; ///< 0 to 1
  Image<float> OffsetX;  ///< where in the pixel the depth was taken, px from its centre
  Image<float> OffsetY;
};

CoveredBuffer RasteriseCovered(
  const TriangleMesh& mesh, const Camera& camera, int samples, const Execution& execution)
{
  const ItemBuffer fine = Rasterise(mesh, Supersampled(camera, samples), execution);
  CoveredBuffer result;
  result.CellId = Image<int>(camera.Width, camera.Height, 1, -1);
  result.Depth = Image<float>(camera.Width, camera.Height, 1, NoDepth);
  result.Coverage = Image<float>(camera.Width, camera.Height);
  result.OffsetX = Image<float>(camera.Width, camera.Height);
  result.OffsetY = Image<float>(camera.Width, camera.Height);
  const int middle = samples / 2;
  execution.ForEach(camera.Height,
    [&](std::int64_t row)
    {
      const int y = static_cast<int>(row);
      for (int x = 0; x < camera.Width; ++x)
      {
        int hits = 0;
        int nearest = std::numeric_limits<int>::max();
        for (int j = 0; j < samples; ++j)
        {
          for (int i = 0; i < samples; ++i)
          {
            const int fx = x * samples + i;
            const int fy = y * samples + j;
            if (!fine.Hit(fx, fy))
            {
              continue;
            }
            ++hits;
            const int distance = (i - middle) * (i - middle) + (j - middle) * (j - middle);
            if (distance < nearest)
            {
              nearest = distance;
              result.CellId(x, y) = fine.CellId(fx, fy);
              result.Depth(x, y) = fine.Depth(fx, fy);
              result.OffsetX(x, y) = static_cast<float>(i - middle) / samples;
              result.OffsetY(x, y) = static_cast<float>(j - middle) / samples;
            }
          }
        }
        result.Coverage(x, y) = static_cast<float>(hits) / (samples * samples);
      }
    });
  return result;
}

/** Fills what no reference sees with the mean of its neighbours, a layer at a time. */
void FillUnseen(Image<float>& color, const Image<std::uint8_t>& mask, Image<std::uint8_t> known)
{
  std::vector<std::pair<int, int>> open;
  for (int y = 0; y < mask.Height; ++y)
  {
    for (int x = 0; x < mask.Width; ++x)
    {
      if (mask(x, y) && !known(x, y))
      {
        open.emplace_back(x, y);
      }
    }
  }
  const auto knownRef = known.Ref();
  while (!open.empty())
  {
    std::vector<std::pair<int, int>> filled;
    std::vector<std::pair<int, int>> rest;
    for (const auto& [x, y] : open)
    {
      double sum[3] = { 0, 0, 0 };
      int count = 0;
      for (int n = 0; n < 9; ++n)
      {
        const int i = x + n % 3 - 1;
        const int j = y + n / 3 - 1;
        if (knownRef.Contains(i, j) && known(i, j))
        {
          ++count;
          for (int channel = 0; channel < 3; ++channel)
          {
            sum[channel] += color(i, j, channel);
          }
        }
      }
      for (int channel = 0; channel < 3 && count; ++channel)
      {
        color(x, y, channel) = static_cast<float>(sum[channel] / count);
      }
      (count ? filled : rest).emplace_back(x, y);
    }
    if (filled.empty())
    {
      return; // an island no reference sees any pixel of stays black, and flagged
    }
    for (const auto& [x, y] : filled)
    {
      known(x, y) = 1;
    }
    open = std::move(rest);
  }
}
}

TexturedView TextureView(const TriangleMesh& mesh, const TriangleMesh* occluders,
  const std::vector<View>& views, const Camera& camera, const TextureOptions& options,
  const Execution& execution)
{
  const CoveredBuffer buffer = RasteriseCovered(mesh, camera, options.RimSamples, execution);
  execution.Report(0.2);
  const std::vector<Reference> references =
    MakeReferences(mesh, occluders, views, camera, options, execution);
  execution.Report(0.5);

  const int width = camera.Width;
  const int height = camera.Height;
  TexturedView result;
  result.Color = Image<std::uint8_t>(width, height, 3);
  result.Mask = Image<std::uint8_t>(width, height);
  result.Depth = Image<float>(width, height);
  result.CellId = Image<int>(width, height, 1, -1);
  result.Seen = Image<std::uint8_t>(width, height);
  Image<float> color(width, height, 3);
  execution.ParallelFor(height,
    [&](std::int64_t begin, std::int64_t end)
    {
      Blender blender(references, camera, options);
      for (int y = static_cast<int>(begin); y < end; ++y)
      {
        for (int x = 0; x < width; ++x)
        {
          if (buffer.Coverage(x, y) < 0.5f)
          {
            continue;
          }
          const Vector2d pixel(x + buffer.OffsetX(x, y), y + buffer.OffsetY(x, y));
          const Vector3d point = camera.Unproject(pixel, buffer.Depth(x, y));
          double rgb[3];
          result.Mask(x, y) = 255;
          result.Depth(x, y) = buffer.Depth(x, y);
          result.CellId(x, y) = buffer.CellId(x, y);
          result.Seen(x, y) = blender.Blend(point, rgb);
          for (int channel = 0; channel < 3; ++channel)
          {
            color(x, y, channel) = static_cast<float>(rgb[channel]);
          }
        }
      }
    });
  execution.Report(0.9);
  FillUnseen(color, result.Mask, result.Seen);
  execution.ForEach(height,
    [&](std::int64_t y)
    {
      for (int x = 0; x < width; ++x)
      {
        for (int channel = 0; channel < 3 && result.Mask(x, y); ++channel)
        {
          const float value = color(x, y, channel) * buffer.Coverage(x, y);
          result.Color(x, y, channel) =
            static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
        }
      }
    });
  execution.Report(1);
  return result;
}
}
