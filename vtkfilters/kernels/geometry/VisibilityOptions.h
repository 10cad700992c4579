// SPDX-License-Identifier: GPL-3.0-or-later
/** Arguments of VisibleVertices() and SplitLongEdges(). Without Eigen, since a header of a VTK class includes it. */
#ifndef novelview_VisibilityOptions_h
#define novelview_VisibilityOptions_h

#include "core/Parameter.h"

namespace novelview
{
struct VisibilityOptions
{
  /** How much deeper than the mesh a hidden vertex lies. */
  static constexpr Parameter<double> ToleranceParameter{ 1e-6, 0, 0.1,
    "diagonals of the bounding box" };
  double Tolerance = ToleranceParameter.Default;

  /** Longer edges are split; 0 = none. */
  static constexpr Parameter<double> LongestEdgePxParameter{ 0, 0, 1000, "px" };
  double LongestEdgePx = LongestEdgePxParameter.Default;
};
}

#endif
