// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/ViewSelection.h"

#include "geometry/TriangleMesh.h"

#include <algorithm>
#include <numeric>

namespace novelview
{
using Eigen::Vector3d;

std::vector<int> ViewsByAngle(const std::vector<View>& views, const Vector3d& direction)
{
  std::vector<int> order(views.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<double> cosine(views.size());
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    cosine[i] = views[i].Cam.OpticalAxis().dot(direction);
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return cosine[a] > cosine[b]; });
  return order;
}

std::vector<std::vector<int>> NearestNeighbours(const std::vector<View>& views, int count)
{
  std::vector<std::vector<int>> neighbours(views.size());
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    for (const int j : ViewsByAngle(views, views[i].Cam.OpticalAxis()))
    {
      if (j != static_cast<int>(i) && static_cast<int>(neighbours[i].size()) < count)
      {
        neighbours[i].push_back(j);
      }
    }
  }
  return neighbours;
}

double MedianFootprint(const std::vector<View>& views, const Vector3d& at)
{
  std::vector<double> sizes;
  for (const View& view : views)
  {
    const double depth = view.Cam.Depth(at);
    if (depth > 0)
    {
      sizes.push_back(view.Cam.PixelFootprint(depth));
    }
  }
  if (sizes.empty())
  {
    return 0;
  }
  std::nth_element(sizes.begin(), sizes.begin() + sizes.size() / 2, sizes.end());
  return sizes[sizes.size() / 2];
}

double MedianFootprint(const std::vector<View>& views, const std::vector<Vector3d>& points)
{
  return points.empty() ? 0 : MedianFootprint(views, BoundingBox(points).center());
}
}
