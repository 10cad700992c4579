// SPDX-License-Identifier: GPL-3.0-or-later
/** Defaults and ranges of TextureOptions and TextureAtlasOptions. Without Eigen, since headers of VTK classes include it. */
#ifndef novelview_TextureParameters_h
#define novelview_TextureParameters_h

#include "core/Parameter.h"

namespace novelview
{
/** Of TextureOptions. */
struct TextureParameters
{
  static constexpr Parameter<int> References{ 3, 1, 64 };
  static constexpr Parameter<double> Power{ 8, 0, 64 };
  static constexpr Parameter<double> FeatherPx{ 2, 0.01, 100, "px" };
  static constexpr Parameter<double> OcclusionPx{ 0, 0, 100, "pixel footprints" };
  static constexpr bool UseDepthMaps = false;
  static constexpr bool UseGains = false;
  static constexpr Parameter<int> BoundarySamples{ 1, 1, 9 };
  static constexpr bool SoftBoundary = false;
};

/** Of TextureAtlasOptions, which is for no novel camera: softer, and balanced, by default. */
struct TextureAtlasParameters
{
  static constexpr Parameter<int> LargestSidePx{ 4096, 64, 16384, "px" };
  static constexpr Parameter<int> References = TextureParameters::References;
  static constexpr Parameter<double> Power = TextureParameters::Power.WithDefault(16);
  static constexpr Parameter<double> FeatherPx = TextureParameters::FeatherPx.WithDefault(20);
  static constexpr Parameter<double> OcclusionPx = TextureParameters::OcclusionPx.WithDefault(1.5);
  static constexpr bool UseGains = true;
};
}

#endif
