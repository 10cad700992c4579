// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CameraCheck_h
#define novelview_CameraCheck_h

#include "check/CheckContext.h"

namespace novelview
{
/** Implausible cameras, see FindCameraAnomalies(). */
void CheckCameras(CheckContext& context);
}

#endif
