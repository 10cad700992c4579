// SPDX-License-Identifier: GPL-3.0-or-later
/** Defaults and ranges of VisualHullOptions. Without Eigen, since headers of VTK classes include it. */
#ifndef novelview_VisualHullParameters_h
#define novelview_VisualHullParameters_h

#include "core/Parameter.h"

namespace novelview
{
struct VisualHullParameters
{
  static constexpr Parameter<double> SpacingPx{ 2, 0.25, 64, "px" };
  static constexpr bool KeepAllComponents = false;
};
}

#endif
