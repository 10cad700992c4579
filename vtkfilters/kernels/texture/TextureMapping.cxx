// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/TextureMapping.h"

#include "core/FillHolesIteratively.h"
#include "core/FunctionMultiversioning.h"
#include "core/ToInt.h"
#include "texture/PhotoBlender.h"

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

/** How much of a pixel the mesh covers, and which subsample gave the pixel its depth. */
struct RimCoverage
{
  float Covered; ///< 0 to 1
  int Column;
  int Row;
};

/**
 * Item buffer with the share of each pixel that the mesh covers. A pixel whose centre is missed but
 * of which half is covered takes the hit subsample nearest the centre.
 */
struct CoveredBuffer
{
  ItemBuffer Front;
  Subsamples Rays;              ///< through the pixels next to which another is not hit as they are
  std::vector<RimCoverage> Rim; ///< of those pixels

  /** How much of a pixel is covered, 0 to 1. */
  float Covered(int x, int y) const
  {
    const int rim = this->Rays.Index(x, y);
    return rim >= 0 ? this->Rim[rim].Covered : (this->Front.Hit(x, y) ? 1.f : 0.f);
  }

  /** The point of a pixel's square that its depth belongs to. */
  Vector2d Place(int x, int y) const
  {
    const int rim = this->Rays.Index(x, y);
    if (rim < 0)
    {
      return Vector2d(x, y);
    }
    const RimCoverage& found = this->Rim[rim];
    return { x + this->Rays.Grid.Offset[found.Column], y + this->Rays.Grid.Offset[found.Row] };
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

/** Settles a rim pixel by its subsamples. */
void CoverRimPixel(CoveredBuffer& buffer, int x, int y)
{
  const Subsamples& rays = buffer.Rays;
  const int perSide = rays.Grid.PerSide;
  const int middle = perSide / 2;
  RimCoverage& rim = buffer.Rim[rays.Index(x, y)];
  int hits = 0;
  int nearest = std::numeric_limits<int>::max();
  buffer.Front.CellId(x, y) = -1;
  for (int row = 0; row < perSide; ++row)
  {
    const std::size_t first = rays.First(x, y) + row * rays.Grid.Stride;
    for (int column = 0; column < perSide; ++column)
    {
      if (rays.CellId[first + column] < 0)
      {
        continue;
      }
      ++hits;
      const int i = column - middle;
      const int j = row - middle;
      if (i * i + j * j < nearest)
      {
        nearest = i * i + j * j;
        buffer.Front.CellId(x, y) = rays.CellId[first + column];
        buffer.Front.Depth(x, y) = rays.Depth[first + column];
        rim.Column = column;
        rim.Row = row;
      }
    }
  }
  rim.Covered = static_cast<float>(hits) / (perSide * perSide);
}

CoveredBuffer RasteriseCovered(
  const TriangleMesh& mesh, const Camera& camera, int samples, const Execution& execution)
{
  const ProjectedMesh inFrame(mesh, camera, execution);
  ItemBuffer front = inFrame.Rasterise();
  const Image<std::uint8_t> rim =
    samples > 1 ? RimPixels(front, execution) : Image<std::uint8_t>(camera.Width, camera.Height);
  CoveredBuffer result{ std::move(front), inFrame.RasteriseSubsamples(rim, samples), {} };
  result.Rim.resize(result.Rays.Pixels);
  execution.ForEach(camera.Height,
    [&](std::int64_t row)
    {
      const int y = static_cast<int>(row);
      for (int x = 0; x < camera.Width; ++x)
      {
        if (rim(x, y))
        {
          CoverRimPixel(result, x, y);
        }
      }
    });
  return result;
}

using PixelList = std::vector<std::pair<int, int>>;

/** Gives `open` pixels, which no reference sees, the mean of their neighbours, a layer at a time. */
void FillUnseen(const PixelList& open, Image<float>& color, Image<std::uint8_t>& known)
{
  const auto knownRef = known.Ref();
  // An island no reference sees any pixel of stays black, and flagged.
  FillHolesIteratively(
    open,
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

/** A colour in whole steps; black shines through by what is not covered. */
void StoreColor(const float color[3], float covered, std::uint8_t* rgb)
{
  for (int channel = 0; channel < 3; ++channel)
  {
    const double value = ClampedNumber(color[channel] * covered, 0, 255);
    rgb[channel] = static_cast<std::uint8_t>(value + 0.5);
  }
}

/** The picture while it is made. */
struct PictureInWork
{
  TexturedView& Result;
  Image<float> Color;
  Image<std::uint8_t> Known;   ///< whether a pixel has its colour
  std::vector<PixelList> Open; ///< in each row, the pixels that are drawn but not seen

  explicit PictureInWork(TexturedView& result)
    : Result(result)
    , Color(result.Mask.Width, result.Mask.Height, 3)
    , Known(result.Mask.Width, result.Mask.Height)
    , Open(result.Mask.Height)
  {
  }
};

TexturedView EmptyView(int width, int height)
{
  TexturedView view;
  view.Color = Image<std::uint8_t>(width, height, 3);
  view.Mask = Image<std::uint8_t>(width, height);
  view.Depth = Image<float>(width, height);
  view.CellId = Image<int>(width, height, 1, -1);
  view.Seen = Image<std::uint8_t>(width, height);
  return view;
}

/** Blends what the references see. */
void BlendPixels(const CoveredBuffer& buffer, const std::vector<BlendReference>& references,
  const Camera& camera, const TextureOptions& options, const Execution& execution,
  PictureInWork& picture)
{
  TexturedView& result = picture.Result;
  const Vector3d centre = camera.Centre();
  const Matrix3d raysOfPixels = camera.R.transpose() * camera.K.inverse();
  execution.ForEachWith(
    camera.Height, [&] { return PhotoBlender(references, options); },
    [&](PhotoBlender& blender, std::int64_t row)
    {
      const int y = static_cast<int>(row);
      for (int x = 0; x < camera.Width; ++x)
      {
        const float covered = buffer.Covered(x, y);
        if (covered < 0.5f && !(options.SoftBoundary && covered > 0))
        {
          continue;
        }
        const float depth = buffer.Front.Depth(x, y);
        const Vector3d ray = raysOfPixels * buffer.Place(x, y).homogeneous();
        double rgb[3];
        const bool seen = blender.Blend(centre + depth * ray, ray.normalized(), rgb);
        float* color = &picture.Color(x, y);
        std::copy_n(rgb, 3, color);
        picture.Known(x, y) = seen;
        if (seen)
        {
          StoreColor(color, covered, &result.Color(x, y));
        }
        else
        {
          picture.Open[y].emplace_back(x, y);
        }
        if (covered >= 0.5f)
        {
          result.Mask(x, y) = 255;
          result.Depth(x, y) = depth;
          result.CellId(x, y) = buffer.Front.CellId(x, y);
          result.Seen(x, y) = seen;
        }
      }
    });
}

/** Gives colours to the pixels that are drawn but that no reference sees. */
void FillPixels(const CoveredBuffer& buffer, PictureInWork& picture)
{
  PixelList open;
  for (const PixelList& row : picture.Open)
  {
    open.insert(open.end(), row.begin(), row.end());
  }
  FillUnseen(open, picture.Color, picture.Known);
  for (const auto& [x, y] : open)
  {
    StoreColor(&picture.Color(x, y), buffer.Covered(x, y), &picture.Result.Color(x, y));
  }
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
  const CoveredBuffer buffer = RasteriseCovered(mesh, camera, options.BoundarySamples, execution);
  execution.Report(0.2);
  const std::vector<BlendReference> references =
    ReferencesFor(mesh, occluders, views, camera, options, execution);
  execution.Report(0.5);

  TexturedView result = EmptyView(camera.Width, camera.Height);
  PictureInWork picture(result);
  BlendPixels(buffer, references, camera, options, execution, picture);
  execution.Report(0.9);
  FillPixels(buffer, picture);
  execution.Report(1);
  return result;
}
}
