// SPDX-License-Identifier: GPL-3.0-or-later
/** Options of FuseDepthMaps(). Without Eigen, since a header of a VTK class includes it. */
#ifndef novelview_FusedSurfaceOptions_h
#define novelview_FusedSurfaceOptions_h

#include "core/Parameter.h"

namespace novelview
{
struct FusedSurfaceOptions
{
  /** Distance of the lattice's points, and so of the mesh's, in the photographs. */
  static constexpr Parameter<double> SpacingPxParameter{ 1.25, 0.25, 64, "px" };
  double SpacingPx = SpacingPxParameter.Default;

  /** Error of the depth maps: truncation and prior grow with it. 0 = exact; of a filter, as measured. */
  static constexpr Parameter<double> DepthNoiseParameter{ 0, 0, 10, "pixel footprints" };
  double DepthNoise = DepthNoiseParameter.Default;
  /** Noisier maps match little but sensor noise, and carve where there is surface. */
  static constexpr double MaxDepthNoise = 1.5;

  /** Whether every component stays, not only the one with the most triangles. */
  bool KeepAllComponents = false;

  double GrazingPower = 1.5;    ///< confidence falls with cos(incidence) to this power
  double Smoothing = 0.3;       ///< lambda of SparseTsdf::Smooth()
  int SmoothingIterations = 40; ///< of it
};
}

#endif
