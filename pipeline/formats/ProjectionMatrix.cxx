// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/ProjectionMatrix.h"

#include "core/Error.h"

#include <Eigen/Dense>

namespace novelview
{
void SetFromProjection(const ProjectionMatrix& P, const std::string& where, Camera& camera)
{
  Eigen::Matrix3d M = P.leftCols<3>();
  const double determinant = M.determinant();
  if (!P.allFinite() || !(std::abs(determinant) > 0))
  {
    throw Error(where, "is no projection of a camera", "a matrix without inverse", "K [R t]");
  }
  const double sign = determinant > 0 ? 1 : -1;
  M *= sign;
  // M = K R with K upper triangular: the QR decomposition of the inverse.
  const Eigen::HouseholderQR<Eigen::Matrix3d> qr(M.inverse());
  Eigen::Matrix3d K = Eigen::Matrix3d(qr.matrixQR().triangularView<Eigen::Upper>()).inverse();
  Eigen::Matrix3d R = Eigen::Matrix3d(qr.householderQ()).transpose();
  const Eigen::Vector3d signs = K.diagonal().cwiseSign();
  K = K * signs.asDiagonal();
  R = signs.asDiagonal() * R;
  camera.T = sign * (K.inverse() * P.col(3));
  camera.K = K / K(2, 2);
  camera.K.triangularView<Eigen::StrictlyLower>().setZero();
  camera.R = R;
}
}
