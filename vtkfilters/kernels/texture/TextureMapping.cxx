// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/TextureMapping.h"

#include "core/FillHolesIteratively.h"
#include "core/ToInt.h"
#include "texture/CoveredBuffer.h"
#include "texture/FarPixels.h"
#include "texture/PhotoBlender.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
  Image<std::uint8_t> Far;     ///< whether it has it from far aside
  Image<float> Depth;          ///< of every pixel drawn
  std::vector<PixelList> Open; ///< in each row, the pixels that are drawn but not seen

  explicit PictureInWork(TexturedView& result)
    : Result(result)
    , Color(result.Mask.Width, result.Mask.Height, 3)
    , Known(result.Mask.Width, result.Mask.Height)
    , Far(result.Mask.Width, result.Mask.Height)
    , Depth(result.Mask.Width, result.Mask.Height)
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

/** The cosine to the viewing ray below which references are far aside. */
double FarCosine(const std::vector<BlendReference>& references, const Camera& camera,
  const TextureOptions& options)
{
  if (options.FarDeg <= 0 || references.size() < 2)
  {
    return -1;
  }
  std::vector<double> angles;
  for (const BlendReference& reference : references)
  {
    const double cosine = reference.Photo->Cam.OpticalAxis().dot(camera.OpticalAxis());
    angles.push_back(std::acos(std::clamp(cosine, -1.0, 1.0)));
  }
  std::nth_element(angles.begin(), angles.begin() + 1, angles.end());
  return std::cos(angles[1] + options.FarDeg * EIGEN_PI / 180);
}

/** The references of a picture, and the viewing rays of its camera. */
struct BlendInput
{
  const std::vector<BlendReference>& References;
  const TextureOptions& Options;
  Vector3d Centre;
  Matrix3d RaysOfPixels;
  double FarCosine; ///< see FarCosine()

  BlendInput(const std::vector<BlendReference>& references, const Camera& camera,
    const TextureOptions& options)
    : References(references)
    , Options(options)
    , Centre(camera.Centre())
    , RaysOfPixels(camera.R.transpose() * camera.K.inverse())
    , FarCosine(novelview::FarCosine(references, camera, options))
  {
  }

  PhotoBlender NewBlender() const { return { this->References, this->Options }; }

  /** PhotoBlender::Blend() for the surface point of a pixel. */
  bool Blend(PhotoBlender& blender, const Vector2d& pixel, double depth, double rgb[3],
    double maxCosine = 1) const
  {
    const Vector3d ray = this->RaysOfPixels * pixel.homogeneous();
    return blender.Blend(this->Centre + depth * ray, ray.normalized(), rgb, maxCosine);
  }
};

/** Blends what the references see; returns whether there is a far pixel. */
bool BlendPixels(const CoveredBuffer& buffer, const BlendInput& input, const Execution& execution,
  PictureInWork& picture)
{
  TexturedView& result = picture.Result;
  std::vector<std::uint8_t> farRows(result.Mask.Height, 0);
  execution.ForEachWith(
    result.Mask.Height, [&] { return input.NewBlender(); },
    [&](PhotoBlender& blender, std::int64_t row)
    {
      const int y = static_cast<int>(row);
      for (int x = 0; x < result.Mask.Width; ++x)
      {
        const float covered = buffer.Covered(x, y);
        if (covered < 0.5f && !(input.Options.SoftBoundary && covered > 0))
        {
          continue;
        }
        const float depth = buffer.Front.Depth(x, y);
        double rgb[3];
        const bool seen = input.Blend(blender, buffer.Place(x, y), depth, rgb);
        float* color = &picture.Color(x, y);
        std::copy_n(rgb, 3, color);
        picture.Known(x, y) = seen;
        picture.Far(x, y) = blender.MeanCosine() < input.FarCosine;
        farRows[y] |= picture.Far(x, y);
        picture.Depth(x, y) = depth;
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
  return std::find(farRows.begin(), farRows.end(), 1) != farRows.end();
}

/** Whether a far pixel lies within FarSeamPx. */
bool IsNearFarPixel(const Image<std::uint8_t>& far, int x, int y)
{
  for (int v = std::max(y - FarSeamPx, 0); v <= std::min(y + FarSeamPx, far.Height - 1); ++v)
  {
    const std::uint8_t* row = &far(0, v);
    const int end = std::min(x + FarSeamPx + 1, far.Width);
    if (std::find(row + std::max(x - FarSeamPx, 0), row + end, 1) != row + end)
    {
      return true;
    }
  }
  return false;
}

/**
 * Brings the pixels that only references far aside see to the level of those around. Returns the
 * islands among them, whose level is unknown.
 */
std::vector<PixelList> LevelPixels(const CoveredBuffer& buffer, const BlendInput& input,
  double focalLength, const Execution& execution, PictureInWork& picture)
{
  Image<std::uint8_t> seam(picture.Far.Width, picture.Far.Height);
  Image<float> seamColor(picture.Far.Width, picture.Far.Height, 3);
  execution.ForEachWith(
    seam.Height, [&] { return input.NewBlender(); },
    [&](PhotoBlender& blender, std::int64_t row)
    {
      const int y = static_cast<int>(row);
      for (int x = 0; x < seam.Width; ++x)
      {
        if (!picture.Known(x, y) || picture.Far(x, y) || !IsNearFarPixel(picture.Far, x, y))
        {
          continue;
        }
        double rgb[3];
        seam(x, y) =
          input.Blend(blender, buffer.Place(x, y), picture.Depth(x, y), rgb, input.FarCosine);
        std::copy_n(rgb, 3, &seamColor(x, y));
      }
    });
  const FarPixelInput far{ std::as_const(picture.Far).Ref(), std::as_const(picture.Depth).Ref(),
    focalLength, std::as_const(seam).Ref(), std::as_const(seamColor).Ref() };
  LevelFarPixels(far, picture.Color);
  for (int y = 0; y < picture.Far.Height; ++y)
  {
    for (int x = 0; x < picture.Far.Width; ++x)
    {
      if (picture.Far(x, y) && picture.Known(x, y))
      {
        StoreColor(&picture.Color(x, y), buffer.Covered(x, y), &picture.Result.Color(x, y));
      }
    }
  }
  Image<std::uint8_t> unseen(seam.Width, seam.Height);
  for (const PixelList& row : picture.Open)
  {
    for (const auto& [x, y] : row)
    {
      unseen(x, y) = 1;
    }
  }
  return FindFarIslands(far, std::as_const(unseen).Ref());
}

/** Gives a pixel the mean of its known neighbours; false when there are none. */
bool FillPixel(PictureInWork& picture, const std::pair<int, int>& pixel)
{
  const auto [x, y] = pixel;
  double sum[3] = { 0, 0, 0 };
  int count = 0;
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, picture.Known.Height - 1); ++j)
  {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, picture.Known.Width - 1); ++i)
    {
      if (picture.Known(i, j))
      {
        ++count;
        for (int channel = 0; channel < 3; ++channel)
        {
          sum[channel] += picture.Color(i, j, channel);
        }
      }
    }
  }
  for (int channel = 0; channel < 3 && count; ++channel)
  {
    picture.Color(x, y, channel) = static_cast<float>(sum[channel] / count);
  }
  return count > 0;
}

/** The sum of all channels of some pixels. */
double SumOf(const Image<float>& color, const PixelList& pixels)
{
  double sum = 0;
  for (const auto& [x, y] : pixels)
  {
    sum += color(x, y, 0) + color(x, y, 1) + color(x, y, 2);
  }
  return sum;
}

/**
 * Gives colours to the pixels that are drawn but that no reference sees, a layer at a time. Islands
 * of which no reference sees any pixel stay black, and flagged. Far islands are passed over, and then
 * brought to the level of what is filled in their place.
 */
void FillPixels(
  const CoveredBuffer& buffer, const std::vector<PixelList>& farIslands, PictureInWork& picture)
{
  PixelList open;
  for (const PixelList& row : picture.Open)
  {
    open.insert(open.end(), row.begin(), row.end());
  }
  const Image<float> own = farIslands.empty() ? Image<float>() : picture.Color;
  for (const PixelList& island : farIslands)
  {
    for (const auto& [x, y] : island)
    {
      picture.Known(x, y) = 0;
    }
    open.insert(open.end(), island.begin(), island.end());
  }
  FillHolesIteratively(
    open, [&](const std::pair<int, int>& pixel) { return FillPixel(picture, pixel); },
    [&](const std::pair<int, int>& pixel) { picture.Known(pixel.first, pixel.second) = 1; });
  for (const PixelList& island : farIslands)
  {
    const double before = SumOf(own, island);
    const auto factor = static_cast<float>(before > 0 ? SumOf(picture.Color, island) / before : 1);
    for (const auto& [x, y] : island)
    {
      for (int channel = 0; channel < 3; ++channel)
      {
        picture.Color(x, y, channel) = factor * own(x, y, channel);
      }
    }
  }
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
  const BlendInput input(references, camera, options);
  const bool anyFar = BlendPixels(buffer, input, execution, picture);
  execution.Report(0.9);
  const std::vector<PixelList> farIslands = anyFar
    ? LevelPixels(buffer, input, camera.FocalLength(), execution, picture)
    : std::vector<PixelList>();
  FillPixels(buffer, farIslands, picture);
  execution.Report(1);
  return result;
}
}
