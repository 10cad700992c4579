// SPDX-License-Identifier: GPL-3.0-or-later
/** Defaults and ranges of the deformers' option structs. Without Eigen, since headers of VTK classes include it. */
#ifndef novelview_DeformationParameters_h
#define novelview_DeformationParameters_h

#include "core/Parameter.h"

namespace novelview
{
/** Of all deformers. */
struct DeformationParameters
{
  static constexpr Parameter<int> Iterations{ 10, 0, 1000 };
};

/** Of OutlineOptions. */
struct OutlineParameters
{
  static constexpr Parameter<double> Alpha{ 0.3, 0, 100 };
  static constexpr Parameter<double> Beta{ 0.3, 0, 100 };
  static constexpr Parameter<double> SearchPx{ 4, 0.25, 50, "px" };
  static constexpr Parameter<int> WindowRadius{ 3, 1, 7, "px" };
  static constexpr Parameter<double> SigmaPx{ 4, 0.5, 100, "px" };
};

/** Of NonOutlineOptions. */
struct NonOutlineParameters
{
  static constexpr Parameter<double> Alpha{ 0.3, 0, 100 };
  static constexpr Parameter<double> SearchPx{ 12, 0.25, 100, "pixel footprints" };
  static constexpr Parameter<int> WindowRadius{ 5, 1, 7, "px" };
  static constexpr Parameter<int> MatchRangePx{ 24, 0, 64, "px" };
};
}

#endif
