// SPDX-License-Identifier: GPL-3.0-or-later
/** Options of TsdfField. Without Eigen, since a header of a VTK class includes it. */
#ifndef novelview_FusionOptions_h
#define novelview_FusionOptions_h

namespace novelview
{
struct FusionOptions
{
  double TruncationPx = 5;      ///< tau, input pixel footprints
  double SurfacePrior = 0.15;   ///< w0: weight of "solid" when the surface is located
  double SilhouettePrior = 0.2; ///< w0m: the same when it is decided whether there is any
  /**
   * How far a depth without texture loses its confidence G at grazing incidence, [0, 1]: there the
   * smoothness of the map has placed it. Factor 1 - GrazingDiscount (1 - G)^3 (1 - cos incidence).
   * Regarded by FindClosestApproach() only.
   */
  double GrazingDiscount = 0;
};
}

#endif
