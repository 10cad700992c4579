// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo/DepthConfidence.h"

#include "geometry/ViewSelection.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

/** World points of a depth map's pixels, relative to the camera's centre. */
class Rays
{
public:
  explicit Rays(const Camera& camera)
    : ToWorld(camera.R.transpose() * camera.K.inverse())
  {
  }
  /** Of unit depth. */
  Vector3d Through(int x, int y) const { return this->ToWorld * Vector3d(x, y, 1); }

private:
  Matrix3d ToWorld;
};

/** Cosine between the viewing ray and the normal of the depth map; 0.1 at least. */
double Incidence(const Rays& rays, const Image<float>& depth, int x, int y)
{
  const float here = depth(x, y);
  const auto at = [&](int i, int j) -> Vector3d
  {
    const bool known = depth.Ref().Contains(i, j) && depth(i, j) > 0;
    return rays.Through(i, j) * (known ? depth(i, j) : here);
  };
  const Vector3d normal = (at(x + 1, y) - at(x - 1, y)).cross(at(x, y + 1) - at(x, y - 1));
  const Vector3d ray = rays.Through(x, y);
  const double length = normal.norm() * ray.norm();
  return length > 0 ? std::max(std::abs(normal.dot(ray)) / length, 0.1) : 0.1;
}

/** A map that another one is held against. */
struct Witness
{
  Witness(const Camera& from, const Camera& to, const Image<float>& map)
    : Map(map)
  {
    const Matrix3d rotation = to.R * from.R.transpose();
    this->H = to.K * rotation * from.K.inverse();
    this->E = to.K * (to.T - rotation * from.T);
  }

  /** How much deeper the map's surface lies than a pixel's point; false if there is none. */
  bool Look(int x, int y, double depth, double& behind) const
  {
    const Vector3d p = this->H * Vector3d(x, y, 1) * depth + this->E;
    const double u = p.x() / p.z() + 0.5;
    const double v = p.y() / p.z() + 0.5;
    if (!(p.z() > 0 && u >= 0 && v >= 0 && u < this->Map.Width && v < this->Map.Height))
    {
      return false;
    }
    const double there = this->Map(static_cast<int>(u), static_cast<int>(v));
    behind = there - p.z();
    return there > 0;
  }

  const Image<float>& Map;
  Matrix3d H; ///< pixel (x, y) at depth d projects to H (x, y, 1) d + E
  Vector3d E;
};

std::vector<Witness> WitnessesOf(
  const std::vector<View>& views, int viewId, const std::vector<Image<float>>& depths, int count)
{
  std::vector<Witness> witnesses;
  const Camera& camera = views[viewId].Cam;
  for (const int other : ViewsByAngle(views, camera.OpticalAxis()))
  {
    if (other != viewId && static_cast<int>(witnesses.size()) < count)
    {
      witnesses.emplace_back(camera, views[other].Cam, depths[other]);
    }
  }
  return witnesses;
}
}

Image<float> DepthConfidence(const std::vector<View>& views, int viewId,
  const std::vector<Image<float>>& depths, const Image<float>& score,
  const ReferenceDepthOptions& options, double footprint, const Execution& execution)
{
  const Image<float>& depth = depths[viewId];
  const Rays rays(views[viewId].Cam);
  const auto witnesses = WitnessesOf(views, viewId, depths, options.AgreementViews);
  const double tolerance = options.AgreementPx * footprint;
  Image<float> confidence(depth.Width, depth.Height);
  for (int y = 0; y < depth.Height; ++y)
  {
    execution.CheckCancelled();
    for (int x = 0; x < depth.Width; ++x)
    {
      if (depth(x, y) <= 0)
      {
        continue;
      }
      int agree = 0;
      int seenThrough = 0;
      double behind;
      for (const Witness& witness : witnesses)
      {
        if (witness.Look(x, y, depth(x, y), behind))
        {
          agree += std::abs(behind) < tolerance;
          seenThrough += behind >= tolerance;
        }
      }
      const double agreement = agree >= 2 ? 1.0 : agree == 1 ? 0.6 : 0.12;
      confidence(x, y) = static_cast<float>(
        score(x, y) * Incidence(rays, depth, x, y) * agreement * (seenThrough > agree ? 0.3 : 1.0));
    }
  }
  return confidence;
}
}
