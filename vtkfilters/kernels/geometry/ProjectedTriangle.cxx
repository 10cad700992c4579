// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/ProjectedTriangle.h"

namespace novelview
{
std::vector<ProjectedPoint> ProjectPoints(
  const TriangleMesh& mesh, const Camera& camera, const Execution& execution)
{
  const Eigen::Matrix3d M = camera.K * camera.R;
  const Eigen::Vector3d t = camera.K * camera.T;
  std::vector<ProjectedPoint> points(mesh.Points.size());
  execution.ForEach(static_cast<std::int64_t>(mesh.Points.size()),
    [&](std::int64_t i)
    {
      const Eigen::Vector3d p = M * mesh.Points[i] + t;
      const double inverse = p.z() > 0 ? 1 / p.z() : 0;
      points[i] = { p.x() * inverse, p.y() * inverse, inverse };
    });
  return points;
}
}
