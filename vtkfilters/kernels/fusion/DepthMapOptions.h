// SPDX-License-Identifier: GPL-3.0-or-later
/** How closely fused depth maps are followed. Without Eigen, since a header of a VTK class includes it. */
#ifndef novelview_DepthMapOptions_h
#define novelview_DepthMapOptions_h

#include "core/Parameter.h"

namespace novelview
{
struct DepthMapOptions
{
  /** Error of the depth maps; 0 = as measured. */
  static constexpr Parameter<double> DepthNoiseParameter{ 0, 0, 10, "pixel footprints" };
  double DepthNoise = DepthNoiseParameter.Default;

  /** FusionOptions::SilhouettePrior at the outline; 0 = estimated from the data. */
  static constexpr Parameter<double> SilhouettePriorParameter{ 0, 0, 10 };
  double SilhouettePrior = SilhouettePriorParameter.Default;

  /** Whether the contour predicted from the photographs' contours refines the outline. */
  bool UsePrediction = false;
};
}

#endif
