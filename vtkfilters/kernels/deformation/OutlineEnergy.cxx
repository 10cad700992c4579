// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/OutlineEnergy.h"

#include "core/ToInt.h"
#include "stereo/PhotoConsistency.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

bool InFrameOf(const View& view, const Vector3d& point, Vector2d& pixel)
{
  if (view.Cam.Depth(point) <= 0)
  {
    return false;
  }
  pixel = view.Cam.Project(point);
  return view.Cam.InFrame(pixel);
}
}

std::optional<Vector2d> OutlineDirection(const ItemBuffer& silhouette, const Vector2d& projection)
{
  const int x = RoundToInt(projection.x());
  const int y = RoundToInt(projection.y());
  Vector2d sum = Vector2d::Zero();
  int background = 0;
  int model = 0;
  const auto cells = silhouette.CellId.Ref();
  for (int j = y - 2; j <= y + 2; ++j)
  {
    for (int i = x - 2; i <= x + 2; ++i)
    {
      if (!cells.Contains(i, j))
      {
        continue;
      }
      if (silhouette.Hit(i, j))
      {
        ++model;
        continue;
      }
      sum += Vector2d(i, j);
      ++background;
    }
  }
  if (background == 0 || model == 0)
  {
    return std::nullopt;
  }
  const Vector2d towards = sum / background - projection;
  const double length = towards.norm();
  if (length < 1e-9)
  {
    return std::nullopt;
  }
  return towards / length;
}

bool OnContour(const ItemBuffer& silhouette, const Vector2d& projection)
{
  const int x = RoundToInt(projection.x());
  const int y = RoundToInt(projection.y());
  const auto cells = silhouette.CellId.Ref();
  bool background = false;
  bool model = false;
  for (const auto& [dx, dy] : { std::pair(0, 0), { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } })
  {
    if (cells.Contains(x + dx, y + dy))
    {
      (silhouette.Hit(x + dx, y + dy) ? model : background) = true;
    }
  }
  return background && model;
}

double OutlinePhotoEnergy(const Vector3d& point, const std::vector<View>& views, int key,
  const std::vector<int>& secondaries, int windowRadius)
{
  Vector2d keyPixel;
  if (secondaries.empty() || !InFrameOf(views[key], point, keyPixel))
  {
    return 1;
  }
  const WindowMatcher window(views[key], keyPixel, windowRadius);
  double sum = 0;
  for (const int viewId : secondaries)
  {
    Vector2d pixel;
    sum +=
      InFrameOf(views[viewId], point, pixel) ? window.ContrastDifference(views[viewId], pixel) : 1;
  }
  return sum / static_cast<double>(secondaries.size());
}

double OutlineContourEnergy(const Vector3d& point, const std::vector<View>& views,
  const std::vector<int>& nearViews, double sigmaPx)
{
  double sum = 0;
  int count = 0;
  for (const int viewId : nearViews)
  {
    Vector2d pixel;
    if (InFrameOf(views[viewId], point, pixel))
    {
      const double distance =
        std::abs(SampleBilinear(views[viewId].ContourDistance, pixel.x(), pixel.y()));
      sum += std::min(distance, sigmaPx) / sigmaPx;
      ++count;
    }
  }
  return count ? sum / count : 0;
}

double OutlineSmoothnessEnergy(
  const Vector3d& point, const Vector3d& direction, const std::vector<Vector3d>& neighbours)
{
  double sum = 0;
  for (const Vector3d& neighbour : neighbours)
  {
    const Vector3d towards = neighbour - point;
    const double length = towards.norm();
    sum += length > 0 ? std::abs(direction.dot(towards)) / length : 0;
  }
  return neighbours.empty() ? 0 : sum / static_cast<double>(neighbours.size());
}
}
