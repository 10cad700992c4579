// SPDX-License-Identifier: GPL-3.0-or-later
#include "cameras/CameraGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace novelview
{
namespace
{
constexpr int Bits = 26;
constexpr int PixelBits = 20;
constexpr int TargetBits = 6; ///< so few that cameras to a few digits have the same target

template <class Matrix>
Matrix InSteps(const Matrix& values, double step)
{
  // Adding 0 makes -0 the same as 0.
  return (values / step).array().round().matrix() * step + Matrix::Zero();
}

/** 2^-bits of a size. Sizes are often 1, 2 or 4, give or take their last bits: no step begins there. */
double StepOf(double size, int bits)
{
  return std::ldexp(1, std::ilogb(0.8 * size) - bits);
}
}

CameraGrid::CameraGrid(const std::vector<Photograph>& photographs)
  : Target(Eigen::Vector3d::Zero())
{
  if (photographs.empty())
  {
    return;
  }
  std::vector<Camera> cameras;
  for (const Photograph& photograph : photographs)
  {
    cameras.push_back(photograph.Cam);
  }
  const Eigen::Vector3d target = CommonTarget(cameras.data(), cameras.size());
  double nearest = std::numeric_limits<double>::infinity();
  for (const Camera& camera : cameras)
  {
    nearest = std::min(nearest, camera.ToCamera(target).norm());
  }
  this->Target = nearest > 0 ? InSteps(target, StepOf(nearest, TargetBits)) : target;
}

Camera CameraGrid::Rounded(const Camera& camera) const
{
  const Eigen::Vector3d target = camera.ToCamera(this->Target);
  const double distance = target.norm();
  if (!(distance > 0))
  {
    return camera;
  }
  Camera result = camera;
  result.R = InSteps(NearestRotation(camera.R), std::ldexp(1, -Bits));
  result.T = InSteps(target, StepOf(distance, Bits)) - result.R * this->Target;
  result.K = InSteps(camera.K, std::ldexp(1, -PixelBits));
  return result;
}

Camera CameraGrid::WithRotation(const Camera& camera) const
{
  Camera result = camera;
  result.R = NearestRotation(camera.R);
  result.T = camera.ToCamera(this->Target) - result.R * this->Target;
  return result;
}
}
