// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/EpipolarDistance.h"

#include <Eigen/LU>

#include <cmath>

namespace novelview
{
double EpipolarDistance(const Camera& first, const Eigen::Vector2d& firstPixel,
  const Camera& second, const Eigen::Vector2d& secondPixel)
{
  const Eigen::Matrix3d r = second.R * first.R.transpose();
  const Eigen::Vector3d t = second.T - r * first.T;
  Eigen::Matrix3d cross;
  cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
  const Eigen::Matrix3d f = second.K.inverse().transpose() * cross * r * first.K.inverse();
  const Eigen::Vector3d line = f * firstPixel.homogeneous();
  const Eigen::Vector3d back = f.transpose() * secondPixel.homogeneous();
  const double gradient = line.head<2>().squaredNorm() + back.head<2>().squaredNorm();
  return gradient > 0 ? std::abs(secondPixel.homogeneous().dot(line)) / std::sqrt(gradient) : 0;
}
}
