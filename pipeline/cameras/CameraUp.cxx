// SPDX-License-Identifier: GPL-3.0-or-later
#include "cameras/CameraUp.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace novelview
{
Eigen::Vector3d UpOfCameras(const std::vector<Camera>& cameras)
{
  const double count = static_cast<double>(cameras.size());
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Camera& camera : cameras)
  {
    up -= camera.R.row(1).transpose() / count;
    middle += camera.Centre() / count;
  }
  if (up.norm() > 0.7)
  {
    return up.normalized();
  }
  // The images do not agree on what is up; then it is the axis that the cameras stand around.
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Camera& camera : cameras)
  {
    const Eigen::Vector3d offset = camera.Centre() - middle;
    spread += offset * offset.transpose();
  }
  const Eigen::Vector3d axis =
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
  // Either end may be up: the one that the images lean to, or else that of a positive coordinate.
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  const double lean = std::abs(axis.dot(up)) > 0.2 ? axis.dot(up) : axis[largest];
  return lean < 0 ? Eigen::Vector3d(-axis) : axis;
}
}
