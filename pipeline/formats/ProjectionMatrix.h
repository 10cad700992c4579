// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ProjectionMatrix_h
#define novelview_ProjectionMatrix_h

#include "geometry/Camera.h"

#include <Eigen/Core>

#include <string>

namespace novelview
{
using ProjectionMatrix = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

/**
 * K, R and T of a camera from P = s K [R t] with any s but 0 (RQ decomposition, K(2,2) = 1, positive
 * focal lengths, R a rotation). Throws Error when P has no such camera.
 */
void SetFromProjection(const ProjectionMatrix& P, const std::string& where, Camera& camera);
}

#endif
