// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/DepthImage.h"

#include "core/FunctionMultiversioning.h"
#include "geometry/ProjectedTriangle.h"
#include "geometry/TriangleDepth.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

namespace novelview
{
namespace
{
NOVELVIEW_CLONES void DrawTriangles(const std::vector<Eigen::Vector3i>& triangles,
  const std::vector<ProjectedPoint>& points, int width, int height, float* nearest, float* farthest)
{
  for (const Eigen::Vector3i& t : triangles)
  {
    const ProjectedTriangle triangle(points[t[0]], points[t[1]], points[t[2]]);
    if (triangle.Drawn())
    {
      TriangleDepth(triangle, -1)
        .Draw(triangle.Box(0, width, height), { width, 0, nearest, farthest });
    }
  }
}

/** Depths of a mesh in an image, in one thread; `farthest` may be null. */
void DrawDepths(
  const TriangleMesh& mesh, const Camera& camera, Image<float>& nearest, Image<float>* farthest)
{
  const std::vector<ProjectedPoint> points = ProjectPoints(mesh, camera, {});
  nearest = Image<float>(camera.Width, camera.Height, 1, NoDepth);
  const std::size_t size = nearest.Values.size();
  nearest.Values.resize(size + 3);
  if (farthest)
  {
    *farthest = Image<float>(camera.Width, camera.Height, 1, 0.f);
    farthest->Values.resize(size + 3);
  }
  DrawTriangles(mesh.Triangles, points, camera.Width, camera.Height, nearest.Values.data(),
    farthest ? farthest->Values.data() : nullptr);
  nearest.Values.resize(size);
  if (farthest)
  {
    farthest->Values.resize(size);
  }
}

/** The integer nearest to a value; the one above from half-way. */
int NearestPixel(double value)
{
  const int whole = static_cast<int>(value + 0.5);
  return whole - (whole > value + 0.5 ? 1 : 0);
}

/** The deepest of the 3x3 pixels around one, of those inside the image; 0 = none has a depth. */
float DeepestAround(const ImageRef<const float>& depth, int x, int y)
{
  using Floats [[gnu::vector_size(16)]] = float;
  if (depth.Contains(x - 1, y - 1) && depth.Contains(x + 2, y + 1)) // a row is read as four
  {
    Floats deepest{};
    for (int j = -1; j <= 1; ++j)
    {
      Floats row;
      std::memcpy(&row, depth.Pixel(x - 1, y + j), sizeof(row));
      row = row < NoDepth ? row : Floats{};
      deepest = deepest > row ? deepest : row;
    }
    return std::max({ deepest[0], deepest[1], deepest[2] });
  }
  float deepest = 0;
  for (int j = y - 1; j <= y + 1; ++j)
  {
    for (int i = x - 1; i <= x + 1; ++i)
    {
      const float value = depth.Contains(i, j) ? depth(i, j) : 0;
      deepest = std::max(deepest, value < NoDepth ? value : 0.f);
    }
  }
  return deepest;
}
}

Image<float> RasteriseDepth(const TriangleMesh& mesh, const Camera& camera)
{
  Image<float> depth;
  DrawDepths(mesh, camera, depth, nullptr);
  return depth;
}

DepthRange RasteriseRange(const TriangleMesh& mesh, const Camera& camera)
{
  DepthRange range;
  DrawDepths(mesh, camera, range.Nearest, &range.Farthest);
  return range;
}

double OcclusionDepth(const ImageRef<const float>& depth, const Eigen::Vector2d& pixel, double z)
{
  if (!(pixel.x() > -2 && pixel.y() > -2 && pixel.x() < depth.Width + 1 &&
        pixel.y() < depth.Height + 1))
  {
    return -std::numeric_limits<double>::infinity();
  }
  const float deepest = DeepestAround(depth, NearestPixel(pixel.x()), NearestPixel(pixel.y()));
  return deepest > 0 ? z - deepest : -std::numeric_limits<double>::infinity();
}

bool IsUnoccluded(const ImageRef<const float>& depth, const Camera& camera,
  const Eigen::Vector3d& point, double tolerancePx)
{
  const double z = camera.Depth(point);
  return OcclusionDepth(depth, camera.Project(point), z) < tolerancePx * camera.PixelFootprint(z);
}
}
