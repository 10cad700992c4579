// SPDX-License-Identifier: GPL-3.0-or-later
/** Defaults and ranges of CameraRefinementOptions. Without Eigen, since headers of VTK classes include it. */
#ifndef novelview_CalibrationParameters_h
#define novelview_CalibrationParameters_h

#include "core/Parameter.h"

namespace novelview
{
struct CalibrationParameters
{
  static constexpr Parameter<double> MinGain{ 0.05, 0, 1 };
};
}

#endif
