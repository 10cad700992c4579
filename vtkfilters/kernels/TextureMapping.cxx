// SPDX-License-Identifier: GPL-3.0-or-later
#include "TextureMapping.h"

#include "FillInLayers.h"
#include "PhotoBlender.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

/** Everything that may hide a surface point from a photograph. */
TriangleMesh SceneOf(const TriangleMesh& mesh, const TriangleMesh* occluders)
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
  return scene;
}

/** The references that may colour something in the camera's picture. */
std::vector<BlendReference> ReferencesFor(const TriangleMesh& mesh, const TriangleMesh* occluders,
  const std::vector<View>& views, const Camera& camera, const TextureOptions& options,
  const Execution& execution)
{
  const bool allHaveDepth = options.UseDepthMaps &&
    std::none_of(
      views.begin(), views.end(), [](const View& view) { return view.DepthMap.Empty(); });
  // More than a right angle off, a photograph shows the other side.
  const Vector3d axis = camera.OpticalAxis();
  return MakeBlendReferences(
    allHaveDepth ? TriangleMesh() : SceneOf(mesh, occluders), views, &axis, options, execution);
}

/**
 * Item buffer with the share of each pixel that the mesh covers. A pixel whose centre is missed but
 * of which half is covered takes the hit sub-ray nearest the centre.
 */
struct CoveredBuffer
{
  ItemBuffer Front;
  Image<float> Coverage;  ///< 0 to 1
  SubRays Rim;            ///< rays through the pixels next to which another is not hit as they are
  Image<Vector2d> Offset; ///< where in the pixel the depth was taken, px from its centre
};

/** The pixels at the border between object and background: some of the 3x3 are hit, some not. */
Image<std::uint8_t> RimPixels(const ItemBuffer& front, const Execution& execution)
{
  const int width = front.CellId.Width;
  const int height = front.CellId.Height;
  Image<std::uint8_t> rim(width, height);
  struct Rows
  {
    std::vector<std::uint8_t> Any; ///< hit in the row or one of those next to it
    std::vector<std::uint8_t> All; ///< hit in all of them
  };
  execution.ForEachWith(
    height, [] { return Rows(); },
    [&](Rows& rows, std::int64_t row)
    {
      const int y = static_cast<int>(row);
      rows.Any.assign(width, 0);
      rows.All.assign(width, 1);
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
      {
        for (int x = 0; x < width; ++x)
        {
          rows.Any[x] |= front.Hit(x, j);
          rows.All[x] &= front.Hit(x, j);
        }
      }
      for (int x = 0; x < width; ++x)
      {
        const int left = std::max(x - 1, 0);
        const int right = std::min(x + 1, width - 1);
        rim(x, y) = (rows.Any[left] | rows.Any[x] | rows.Any[right]) &
          !(rows.All[left] & rows.All[x] & rows.All[right]);
      }
    });
  return rim;
}

/** Settles a rim pixel by its sub-rays. */
void CoverRimPixel(CoveredBuffer& buffer, int x, int y)
{
  const SubRays& rays = buffer.Rim;
  const int perPixel = rays.PerSide * rays.PerSide;
  const int middle = rays.PerSide / 2;
  const std::size_t first = static_cast<std::size_t>(rays.Index(x, y)) * perPixel;
  int hits = 0;
  int nearest = std::numeric_limits<int>::max();
  buffer.Front.CellId(x, y) = -1;
  for (int k = 0; k < perPixel; ++k)
  {
    if (rays.CellId[first + k] < 0)
    {
      continue;
    }
    ++hits;
    const int i = k % rays.PerSide - middle;
    const int j = k / rays.PerSide - middle;
    if (i * i + j * j < nearest)
    {
      nearest = i * i + j * j;
      buffer.Front.CellId(x, y) = rays.CellId[first + k];
      buffer.Front.Depth(x, y) = rays.Depth[first + k];
      buffer.Offset(x, y) = Vector2d(rays.Offset(i + middle), rays.Offset(j + middle));
    }
  }
  buffer.Coverage(x, y) = static_cast<float>(hits) / perPixel;
}

CoveredBuffer RasteriseCovered(
  const TriangleMesh& mesh, const Camera& camera, int samples, const Execution& execution)
{
  CoveredBuffer result;
  result.Front = Rasterise(mesh, camera, execution);
  result.Coverage = Image<float>(camera.Width, camera.Height);
  result.Offset = Image<Vector2d>(camera.Width, camera.Height, 1, Vector2d(0, 0));
  std::transform(result.Front.CellId.Values.begin(), result.Front.CellId.Values.end(),
    result.Coverage.Values.begin(), [](int cellId) { return cellId >= 0 ? 1.f : 0.f; });
  if (samples > 1)
  {
    const Image<std::uint8_t> rim = RimPixels(result.Front, execution);
    result.Rim = RasteriseSubRays(mesh, camera, rim, samples, execution);
    execution.ForEach(camera.Height,
      [&](std::int64_t y)
      {
        for (int x = 0; x < camera.Width; ++x)
        {
          if (result.Rim.Index(x, static_cast<int>(y)) >= 0)
          {
            CoverRimPixel(result, x, static_cast<int>(y));
          }
        }
      });
  }
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
  // An island no reference sees any pixel of stays black, and flagged.
  FillInLayers(
    std::move(open),
    [&](const std::pair<int, int>& pixel)
    {
      const auto [x, y] = pixel;
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
      return count > 0;
    },
    [&](const std::pair<int, int>& pixel) { known(pixel.first, pixel.second) = 1; });
}
}

TexturedView TextureView(const TriangleMesh& mesh, const TriangleMesh* occluders,
  const std::vector<View>& views, const Camera& camera, const TextureOptions& options,
  const Execution& execution)
{
  const CoveredBuffer buffer = RasteriseCovered(mesh, camera, options.RimSamples, execution);
  execution.Report(0.2);
  const std::vector<BlendReference> references =
    ReferencesFor(mesh, occluders, views, camera, options, execution);
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
  // Where there is something to draw: the mask and, with a soft rim, what is covered by less.
  Image<std::uint8_t> drawn(width, height);
  Image<std::uint8_t> seen(width, height);
  const Vector3d centre = camera.Centre();
  execution.ForEachWith(
    height, [&] { return PhotoBlender(references, options); },
    [&](PhotoBlender& blender, std::int64_t row)
    {
      const int y = static_cast<int>(row);
      for (int x = 0; x < width; ++x)
      {
        const float coverage = buffer.Coverage(x, y);
        if (coverage < 0.5f && !(options.SoftRim && coverage > 0))
        {
          continue;
        }
        const Vector3d point =
          camera.Unproject(Vector2d(x, y) + buffer.Offset(x, y), buffer.Front.Depth(x, y));
        double rgb[3];
        drawn(x, y) = 255;
        seen(x, y) = blender.Blend(point, (point - centre).normalized(), rgb);
        if (coverage >= 0.5f)
        {
          result.Mask(x, y) = 255;
          result.Depth(x, y) = buffer.Front.Depth(x, y);
          result.CellId(x, y) = buffer.Front.CellId(x, y);
          result.Seen(x, y) = seen(x, y);
        }
        for (int channel = 0; channel < 3; ++channel)
        {
          color(x, y, channel) = static_cast<float>(rgb[channel]);
        }
      }
    });
  execution.Report(0.9);
  FillUnseen(color, drawn, std::move(seen));
  execution.ForEach(height,
    [&](std::int64_t y)
    {
      for (int x = 0; x < width; ++x)
      {
        for (int channel = 0; channel < 3 && drawn(x, y); ++channel)
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
