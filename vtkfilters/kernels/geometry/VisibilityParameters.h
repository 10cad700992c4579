// SPDX-License-Identifier: GPL-3.0-or-later
/** Defaults and ranges of the arguments of VisibleVertices() and SplitLongEdges(). Without Eigen, since headers of VTK classes include it. */
#ifndef novelview_VisibilityParameters_h
#define novelview_VisibilityParameters_h

#include "core/Parameter.h"

namespace novelview
{
struct VisibilityParameters
{
  static constexpr Parameter<double> Tolerance{ 1e-6, 0, 0.1, "diagonals of the bounding box" };
  static constexpr Parameter<double> LongestEdgePx{ 0, 0, 1000, "px" }; ///< 0 = leave all whole
};
}

#endif
