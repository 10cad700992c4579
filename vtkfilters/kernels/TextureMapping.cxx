// SPDX-License-Identifier: GPL-3.0-or-later
#include "TextureMapping.h"

#include "CpuClones.h"
#include "FillInLayers.h"
#include "PhotoBlender.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace novelview
{
namespace
{
using Eigen::Matrix3d;
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
  // More than a right angle off, a photograph shows the other side.
  const Vector3d axis = camera.OpticalAxis();
  return MakeBlendReferences(NeedsModel(views, options) ? SceneOf(mesh, occluders) : TriangleMesh(),
    views, &axis, options, execution);
}

/**
 * Item buffer with the share of each pixel that the mesh covers. A pixel whose centre is missed but
 * of which half is covered takes the hit sub-ray nearest the centre.
 */
struct CoveredBuffer
{
  ItemBuffer Front;
  Image<float> Coverage;      ///< 0 to 1
  SubRays Rim;                ///< through the pixels next to which another is not hit as they are
  Image<std::uint8_t> SubRay; ///< the sub-ray whose depth a pixel has

  /** The point of a pixel's square that its depth belongs to. */
  Vector2d Place(int x, int y) const
  {
    const int k = this->SubRay(x, y);
    return { x + this->Rim.Offset(k % this->Rim.PerSide),
      y + this->Rim.Offset(k / this->Rim.PerSide) };
  }
};

/** Joins a row of triangle ids to two rows of marks: hit in any row so far, hit in all. */
NOVELVIEW_CLONES void JoinHits(const int* cellIds, int width, std::uint8_t* any, std::uint8_t* all)
{
  for (int x = 0; x < width; ++x)
  {
    const std::uint8_t hit = cellIds[x] >= 0;
    any[x] |= hit;
    all[x] &= hit;
  }
}

/** Marks pixels of which, with the two neighbours in the row, some are hit but not all. */
NOVELVIEW_CLONES void MarkRim(
  const std::uint8_t* any, const std::uint8_t* all, int width, std::uint8_t* rim)
{
  for (int x = 0; x < width; ++x)
  {
    rim[x] = (any[x - 1] | any[x] | any[x + 1]) & ((all[x - 1] & all[x] & all[x + 1]) ^ 1);
  }
}

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
      // With a column more on both sides, of which nothing follows.
      rows.Any.assign(width + 2, 0);
      rows.All.assign(width + 2, 1);
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
      {
        JoinHits(&front.CellId(0, j), width, &rows.Any[1], &rows.All[1]);
      }
      MarkRim(&rows.Any[1], &rows.All[1], width, &rim(0, y));
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
      buffer.SubRay(x, y) = static_cast<std::uint8_t>(k);
    }
  }
  buffer.Coverage(x, y) = static_cast<float>(hits) / perPixel;
}

CoveredBuffer RasteriseCovered(
  const TriangleMesh& mesh, const Camera& camera, int samples, const Execution& execution)
{
  const MeshInFrame inFrame(mesh, camera, execution);
  CoveredBuffer result;
  result.Front = inFrame.Rasterise();
  const Image<std::uint8_t> rim = samples > 1 ? RimPixels(result.Front, execution)
                                              : Image<std::uint8_t>(camera.Width, camera.Height);
  result.Rim = inFrame.RasteriseSubRays(rim, samples);
  result.Coverage = Image<float>(camera.Width, camera.Height);
  const auto middle = static_cast<std::uint8_t>(samples * samples / 2);
  result.SubRay = Image<std::uint8_t>(camera.Width, camera.Height, 1, middle);
  execution.ForEach(camera.Height,
    [&](std::int64_t row)
    {
      const int y = static_cast<int>(row);
      for (int x = 0; x < camera.Width; ++x)
      {
        result.Coverage(x, y) = result.Front.Hit(x, y) ? 1.f : 0.f;
        if (rim(x, y))
        {
          CoverRimPixel(result, x, y);
        }
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

bool NeedsModel(const std::vector<View>& views, const TextureOptions& options)
{
  return !options.UseDepthMaps ||
    std::any_of(views.begin(), views.end(), [](const View& view) { return view.DepthMap.Empty(); });
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
  const Matrix3d raysOfPixels = camera.R.transpose() * camera.K.inverse();
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
        const Vector3d ray = raysOfPixels * buffer.Place(x, y).homogeneous();
        double rgb[3];
        drawn(x, y) = 255;
        seen(x, y) = blender.Blend(centre + buffer.Front.Depth(x, y) * ray, ray.normalized(), rgb);
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
