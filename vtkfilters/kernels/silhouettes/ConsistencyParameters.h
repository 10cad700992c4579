// SPDX-License-Identifier: GPL-3.0-or-later
/** Defaults and ranges of ConsistencyOptions. Without Eigen, since headers of VTK classes include it. */
#ifndef novelview_ConsistencyParameters_h
#define novelview_ConsistencyParameters_h

#include "core/Parameter.h"

namespace novelview
{
struct ConsistencyParameters
{
  static constexpr Parameter<double> MinPx{ 0.5, 0.25, 100, "px" };
  static constexpr Parameter<double> MinShare{ 0.05, 0, 1 };
};
}

#endif
