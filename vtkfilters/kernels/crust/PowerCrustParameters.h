// SPDX-License-Identifier: GPL-3.0-or-later
/** Defaults and ranges of PowerCrustOptions. Without Eigen, since headers of VTK classes include it. */
#ifndef novelview_PowerCrustParameters_h
#define novelview_PowerCrustParameters_h

#include "core/Parameter.h"

#include <limits>

namespace novelview
{
struct PowerCrustParameters
{
  static constexpr Parameter<int> MinimumComponentSamples{ 20, 0, std::numeric_limits<int>::max() };
  static constexpr bool RecoverSamples = true;
};
}

#endif
