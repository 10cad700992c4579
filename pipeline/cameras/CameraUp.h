// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CameraUp_h
#define novelview_CameraUp_h

#include "geometry/Camera.h"

#include <vector>

namespace novelview
{
/**
 * The direction of the world that is up, of length 1: in the cameras' images or, when those
 * disagree (photographs may be turned by a quarter), the axis that the cameras stand around.
 */
Eigen::Vector3d UpOfCameras(const std::vector<Camera>& cameras);
}

#endif
