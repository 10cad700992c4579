// SPDX-License-Identifier: GPL-3.0-or-later
#include "Rasteriser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace novelview
{
namespace
{
constexpr int BandRows = 32;
constexpr float NoDepth = std::numeric_limits<float>::infinity();

struct ProjectedPoint
{
  double X, Y;
  double InverseDepth; ///< 0 = at or behind the camera's plane
};

std::vector<ProjectedPoint> ProjectAll(
  const TriangleMesh& mesh, const Camera& camera, const Execution& execution)
{
  std::vector<ProjectedPoint> projected(mesh.Points.size());
  execution.ForEach(static_cast<std::int64_t>(mesh.Points.size()),
    [&](std::int64_t i)
    {
      const double depth = camera.Depth(mesh.Points[i]);
      if (depth > 0)
      {
        const Eigen::Vector2d u = camera.Project(mesh.Points[i]);
        projected[i] = { u.x(), u.y(), 1 / depth };
      }
      else
      {
        projected[i] = { 0, 0, 0 };
      }
    });
  return projected;
}

/** First and last integer in [low, high], cut to [0, size). */
std::pair<int, int> PixelRange(double low, double high, int size)
{
  const double first = std::max(std::ceil(low), 0.0);
  const double last = std::min(std::floor(high), size - 1.0);
  return first <= last ? std::make_pair(static_cast<int>(first), static_cast<int>(last))
                       : std::make_pair(0, -1);
}

/** Calls take(x, y, depth) for the pixels of one triangle in rows [rowBegin, rowEnd). */
template <class Take>
void DrawTriangle(
  const std::array<ProjectedPoint, 3>& p, int width, int rowBegin, int rowEnd, const Take& take)
{
  const double area = (p[1].X - p[0].X) * (p[2].Y - p[0].Y) - (p[2].X - p[0].X) * (p[1].Y - p[0].Y);
  if (area == 0 || !std::isfinite(area))
  {
    return;
  }
  const auto [xMin, xMax] = std::minmax({ p[0].X, p[1].X, p[2].X });
  const auto [yMin, yMax] = std::minmax({ p[0].Y, p[1].Y, p[2].Y });
  const auto [x0, x1] = PixelRange(xMin, xMax, width);
  auto [y0, y1] = PixelRange(yMin, yMax, rowEnd);
  y0 = std::max(y0, rowBegin);
  for (int y = y0; y <= y1; ++y)
  {
    for (int x = x0; x <= x1; ++x)
    {
      const double w0 = ((p[1].X - x) * (p[2].Y - y) - (p[2].X - x) * (p[1].Y - y)) / area;
      const double w1 = ((p[2].X - x) * (p[0].Y - y) - (p[0].X - x) * (p[2].Y - y)) / area;
      const double w2 = ((p[0].X - x) * (p[1].Y - y) - (p[1].X - x) * (p[0].Y - y)) / area;
      if (w0 >= 0 && w1 >= 0 && w2 >= 0)
      {
        take(x, y,
          static_cast<float>((w0 + w1 + w2) /
            (w0 * p[0].InverseDepth + w1 * p[1].InverseDepth + w2 * p[2].InverseDepth)));
      }
    }
  }
}

/**
 * Calls take(x, y, depth, cellId) for every pixel of every triangle; in parallel, but for each pixel
 * one after the other in the order of the triangles' ids.
 */
template <class Take>
void DrawMesh(
  const TriangleMesh& mesh, const Camera& camera, const Execution& execution, const Take& take)
{
  const std::vector<ProjectedPoint> projected = ProjectAll(mesh, camera, execution);
  const int bands = (camera.Height + BandRows - 1) / BandRows;
  std::vector<std::vector<int>> cellsOfBand(bands);
  for (std::size_t cellId = 0; cellId < mesh.Triangles.size(); ++cellId)
  {
    const Eigen::Vector3i& t = mesh.Triangles[cellId];
    if (projected[t[0]].InverseDepth == 0 || projected[t[1]].InverseDepth == 0 ||
      projected[t[2]].InverseDepth == 0)
    {
      continue;
    }
    const auto [low, high] =
      std::minmax({ projected[t[0]].Y, projected[t[1]].Y, projected[t[2]].Y });
    const auto [first, last] = PixelRange(low, high, camera.Height);
    for (int band = first / BandRows; band <= last / BandRows && first <= last; ++band)
    {
      cellsOfBand[band].push_back(static_cast<int>(cellId));
    }
  }
  execution.ForEach(bands,
    [&](std::int64_t band)
    {
      const int rowBegin = static_cast<int>(band) * BandRows;
      const int rowEnd = std::min(rowBegin + BandRows, camera.Height);
      for (const int cellId : cellsOfBand[band])
      {
        const Eigen::Vector3i& t = mesh.Triangles[cellId];
        DrawTriangle({ projected[t[0]], projected[t[1]], projected[t[2]] }, camera.Width, rowBegin,
          rowEnd, [&](int x, int y, float depth) { take(x, y, depth, cellId); });
      }
    });
}
}

ItemBuffer Rasterise(const TriangleMesh& mesh, const Camera& camera, const Execution& execution)
{
  ItemBuffer buffer;
  buffer.CellId = Image<int>(camera.Width, camera.Height, 1, -1);
  buffer.Depth = Image<float>(camera.Width, camera.Height, 1, NoDepth);
  DrawMesh(mesh, camera, execution,
    [&](int x, int y, float depth, int cellId)
    {
      // Triangles come in the order of their ids, so "nearer" alone lets the lowest id win ties.
      if (depth < buffer.Depth(x, y))
      {
        buffer.Depth(x, y) = depth;
        buffer.CellId(x, y) = cellId;
      }
    });
  return buffer;
}

DepthRange RasteriseRange(
  const TriangleMesh& mesh, const Camera& camera, const Execution& execution)
{
  DepthRange range;
  range.Nearest = Image<float>(camera.Width, camera.Height, 1, NoDepth);
  range.Farthest = Image<float>(camera.Width, camera.Height, 1, 0.f);
  DrawMesh(mesh, camera, execution,
    [&](int x, int y, float depth, int)
    {
      range.Nearest(x, y) = std::min(range.Nearest(x, y), depth);
      range.Farthest(x, y) = std::max(range.Farthest(x, y), depth);
    });
  return range;
}

double DepthBehind(const ImageRef<const float>& depth, const Eigen::Vector2d& pixel, double z)
{
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  float deepest = 0;
  for (int j = y - 1; j <= y + 1; ++j)
  {
    for (int i = x - 1; i <= x + 1; ++i)
    {
      if (depth.Contains(i, j) && std::isfinite(depth(i, j)))
      {
        deepest = std::max(deepest, depth(i, j));
      }
    }
  }
  return deepest > 0 ? z - deepest : -std::numeric_limits<double>::infinity();
}

Camera Supersampled(const Camera& camera, int factor)
{
  Camera result = camera;
  result.K.topRows<2>() *= factor;
  // Pixel x of the small picture covers factor pixels whose middle is factor x + (factor - 1) / 2.
  result.K(0, 2) += 0.5 * (factor - 1);
  result.K(1, 2) += 0.5 * (factor - 1);
  result.Width *= factor;
  result.Height *= factor;
  return result;
}
}
