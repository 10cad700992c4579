// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/LiveFrame.h"

#include "ViewAccess.h"
#include "core/Error.h"
#include "drawing/ShadedMesh.h"
#include "images/ImageFile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace novelview
{
namespace
{
/** White where the surface is nearest, dark grey where it is farthest, black where there is none. */
Image<std::uint8_t> DepthPicture(const ImageRef<const float>& depth)
{
  float nearest = std::numeric_limits<float>::max();
  float farthest = 0;
  for (int y = 0; y < depth.Height; ++y)
  {
    for (int x = 0; x < depth.Width; ++x)
    {
      if (depth(x, y) > 0)
      {
        nearest = std::min(nearest, depth(x, y));
        farthest = std::max(farthest, depth(x, y));
      }
    }
  }
  constexpr float darkest = 48;
  const float scale = (255 - darkest) / std::max(farthest - nearest, 1e-6f * farthest);
  Image<std::uint8_t> grey(depth.Width, depth.Height);
  for (int y = 0; y < depth.Height; ++y)
  {
    for (int x = 0; x < depth.Width; ++x)
    {
      grey(x, y) = depth(x, y) > 0
        ? static_cast<std::uint8_t>(255 - scale * (depth(x, y) - nearest) + 0.5f)
        : std::uint8_t(0);
    }
  }
  return grey;
}

std::vector<std::uint8_t> PngOf(
  const NovelView& view, const Camera& camera, FrameRequest::Picture show)
{
  const char* const where = "frame";
  switch (show)
  {
    case FrameRequest::Picture::Depth:
      return EncodePng(
        DepthPicture(TopDownArray<const float>(view.Image, arrays::Depth, 1, where, true)).Ref(),
        where);
    case FrameRequest::Picture::Mesh:
      return EncodePng(ShadedMesh(ToTriangleMesh(view.Mesh, "mesh"), camera).Ref(), where);
    case FrameRequest::Picture::Colour:
      break;
  }
  return EncodePng(
    TopDownArray<const std::uint8_t>(view.Image, arrays::Color, 3, where, true), where);
}

std::optional<Eigen::Vector3d> PointAt(
  const NovelView& view, const Camera& camera, const std::optional<Eigen::Vector2i>& pixel)
{
  if (!pixel)
  {
    return {};
  }
  const float depth =
    TopDownArray<const float>(view.Image, arrays::Depth, 1, "frame", true)(pixel->x(), pixel->y());
  return depth > 0 ? std::optional(camera.Unproject(pixel->cast<double>(), depth)) : std::nullopt;
}
}

FrameAnswer MakeLiveFrame(Synthesis& synthesis, const CameraGrid& grid, const FrameRequest& request)
{
  FrameAnswer answer;
  try
  {
    const Camera camera = grid.Rounded(request.Cam);
    const NovelView view = synthesis.Render(camera, request.UpTo);
    answer.Png = PngOf(view, camera, request.Show);
    answer.Point = PointAt(view, camera, request.Pick);
    answer.What = FrameAnswer::Kind::Made;
  }
  catch (const Interrupted&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    answer.What = FrameAnswer::Kind::Failed;
    answer.Text = ErrorText(error);
  }
  return answer;
}

std::vector<std::vector<std::uint8_t>> ThumbnailsOf(vtkMultiBlockDataSet* views)
{
  constexpr int longer = 200; // pixels
  constexpr int quality = 85;
  std::vector<std::vector<std::uint8_t>> jpegs;
  for (const View& view : ReadColouredViews(views))
  {
    const double scale =
      std::min(1.0, longer / static_cast<double>(std::max(view.Color.Width, view.Color.Height)));
    const Image<std::uint8_t> small =
      ReducedImage(view.Color, std::max(1, static_cast<int>(std::lround(scale * view.Color.Width))),
        std::max(1, static_cast<int>(std::lround(scale * view.Color.Height))));
    jpegs.push_back(EncodeJpeg(small.Ref(), quality, view.Name));
  }
  return jpegs;
}
}
