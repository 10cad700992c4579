// SPDX-License-Identifier: GPL-3.0-or-later
#include "silhouettes/ContourPrediction.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

/** The tangent plane of one photograph's contour, seen from the point. */
struct TangentPlane
{
  double Theta;    ///< turned against the novel tangent plane, radians
  double Distance; ///< of the plane from the point, world units, above 0 = the point is inside
};

std::optional<TangentPlane> TangentPlaneOf(const View& view, const Vector3d& point,
  const Vector3d& ray, const Vector3d& normal, const ContourPredictionOptions& options)
{
  const double depth = view.Cam.Depth(point);
  if (depth <= 0)
  {
    return std::nullopt;
  }
  const Vector2d u = view.Cam.Project(point);
  const auto at = [&](double dx, double dy)
  { return SampleBilinear(view.ContourDistance, u.x() + dx, u.y() + dy); };
  if (u.x() < 1 || u.y() < 1 || u.x() > view.Cam.Width - 2 || u.y() > view.Cam.Height - 2 ||
    std::abs(at(0, 0)) > options.MaxDistancePx)
  {
    return std::nullopt;
  }
  // Inwards; as long as 2 unless a ridge, where two contours are equally near, lies within a pixel.
  const Vector2d gradient(at(1, 0) - at(-1, 0), at(0, 1) - at(0, -1));
  if (gradient.norm() < 1)
  {
    return std::nullopt;
  }
  // The plane contains the ray to the contour, which is not the one to the point.
  const Vector2d inwards = gradient.normalized();
  const Vector2d contour = u - at(0, 0) * inwards;
  const Vector3d touched = view.Cam.Unproject(contour, depth);
  const Vector3d viewRay = (touched - view.Cam.Centre()).normalized();
  Vector3d outwards = view.Cam.Unproject(contour - inwards, depth) - touched;
  outwards -= outwards.dot(viewRay) * viewRay;
  outwards.normalize();
  TangentPlane plane;
  plane.Theta = std::atan2(outwards.dot(ray), outwards.dot(normal));
  plane.Distance = outwards.dot(touched - point);
  const bool fits = std::abs(outwards.dot(ray.cross(normal))) <= options.MaxTilt &&
    std::abs(plane.Theta) <= options.MaxAngleDeg * EIGEN_PI / 180;
  return fits ? std::optional(plane) : std::nullopt;
}

/** The nearest planes on either side; empty when one side has none or there are less than three. */
std::vector<TangentPlane> NearestPlanes(std::vector<TangentPlane> planes, int perSide)
{
  std::sort(planes.begin(), planes.end(),
    [](const TangentPlane& a, const TangentPlane& b)
    { return std::abs(a.Theta) < std::abs(b.Theta); });
  int count[2] = { 0, 0 };
  std::erase_if(
    planes, [&](const TangentPlane& plane) { return ++count[plane.Theta > 0] > perSide; });
  const bool enough = count[0] > 0 && count[1] > 0 && planes.size() >= 3;
  return enough ? planes : std::vector<TangentPlane>();
}
}

std::optional<PredictedContour> PredictContour(const std::vector<View>& views,
  const Vector3d& point, const Vector3d& ray, const Vector3d& normal,
  const ContourPredictionOptions& options)
{
  std::vector<TangentPlane> planes;
  for (const View& view : views)
  {
    if (const auto plane = TangentPlaneOf(view, point, ray, normal, options))
    {
      planes.push_back(*plane);
    }
  }
  planes = NearestPlanes(std::move(planes), options.PerSide);
  if (planes.empty())
  {
    return std::nullopt;
  }
  // Unknowns R, h0, b; rows weighted by the square root of a Gaussian of the angle.
  constexpr double fall = 40 * EIGEN_PI / 180;
  Eigen::MatrixXd rows(planes.size(), 3);
  Eigen::VectorXd right(planes.size());
  double weights = 0;
  for (std::size_t i = 0; i < planes.size(); ++i)
  {
    const double theta = planes[i].Theta;
    const double weight = std::exp(-0.5 * (theta / fall) * (theta / fall));
    rows.row(i) = weight * Vector3d(1 - std::cos(theta), std::cos(theta), std::sin(theta));
    right[i] = weight * planes[i].Distance;
    weights += weight * weight;
  }
  Vector3d circle = rows.colPivHouseholderQr().solve(right);
  if (circle[0] < 0)
  {
    circle << 0, rows.rightCols<2>().colPivHouseholderQr().solve(right);
  }
  return PredictedContour{ -circle[1], circle[0],
    (rows * circle - right).norm() / std::sqrt(weights) };
}
}
