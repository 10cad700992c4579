// SPDX-License-Identifier: GPL-3.0-or-later
/** Defaults and ranges of what is done with fused depth maps. Without Eigen, since headers of VTK classes include it. */
#ifndef novelview_FusionParameters_h
#define novelview_FusionParameters_h

#include "core/Parameter.h"

namespace novelview
{
struct FusionParameters
{
  /** By how much the depth maps are off; 0 = as measured. */
  static constexpr Parameter<double> DepthNoise{ 0, 0, 10, "pixel footprints" };
  /** FusionOptions::SilhouettePrior at the outline; 0 = found from the data. */
  static constexpr Parameter<double> SilhouettePrior{ 0, 0, 10 };
  static constexpr bool UsePrediction = false;
};
}

#endif
