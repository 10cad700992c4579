// SPDX-License-Identifier: GPL-3.0-or-later
/** Defaults and ranges of ReferenceDepthOptions and MatchOptions. Without Eigen, since headers of VTK classes include it. */
#ifndef novelview_ReferenceDepthParameters_h
#define novelview_ReferenceDepthParameters_h

#include "core/Parameter.h"

namespace novelview
{
struct ReferenceDepthParameters
{
  static constexpr Parameter<int> Neighbours{ 4, 1, 16 };
  static constexpr Parameter<double> CoarseLastPx{ 150, 4, 1000, "pixel footprints" };
  static constexpr Parameter<int> WindowRadius{ 2, 1, 5, "px" };
  static constexpr Parameter<double> ColorShare{ 0.5, 0, 1 };
};
}

#endif
