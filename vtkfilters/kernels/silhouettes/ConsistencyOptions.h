// SPDX-License-Identifier: GPL-3.0-or-later
/** Options of FindContourOffsets(). Without Eigen, since a header of a VTK class includes it. */
#ifndef novelview_ConsistencyOptions_h
#define novelview_ConsistencyOptions_h

#include "core/Parameter.h"

namespace novelview
{
struct ConsistencyOptions
{
  int RaysPerView = 300; ///< about this many rays of each silhouette's contour are followed, and
  int RaysOfAll = 7200;  ///< at most about this many in all, since each meets every view
  /** Smaller offsets and smaller disagreements are ignored. */
  static constexpr Parameter<double> MinPxParameter{ 0.5, 0.25, 100, "px" };
  double MinPx = MinPxParameter.Default;
  /** Part of the others' rays that a silhouette has to cut. */
  static constexpr Parameter<double> MinShareParameter{ 0.05, 0, 1 };
  double MinShare = MinShareParameter.Default;
  double Outstanding = 3;  ///< and this multiple of the median silhouette's part
  int Rounds = 5;          ///< at most, each after the corrections of the last one
  double MaxSlackPx = 0.6; ///< what all are enlarged by at most
};
}

#endif
