// SPDX-License-Identifier: GPL-3.0-or-later
/** Options of ComputeVisualHull(). Without Eigen, since a header of a VTK class includes it. */
#ifndef novelview_VisualHullOptions_h
#define novelview_VisualHullOptions_h

#include "core/Parameter.h"

#include <array>
#include <optional>

namespace novelview
{
struct VisualHullOptions
{
  /** Edge of a lattice cell, in pixels of the photographs at the object's middle. */
  static constexpr Parameter<double> SpacingPxParameter{ 2, 0.25, 64, "px" };
  double SpacingPx = SpacingPxParameter.Default;

  /**
   * Box x0 y0 z0 x1 y1 z1 that bounds the hull, world units. Computed from the silhouettes if not
   * given or empty.
   */
  std::optional<std::array<double, 6>> Box;

  /** Keep every component. Otherwise only the one with the most samples. */
  bool KeepAllComponents = false;
};
}

#endif
