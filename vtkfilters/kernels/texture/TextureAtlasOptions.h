// SPDX-License-Identifier: GPL-3.0-or-later
/** Options of MakeTextureAtlas(). Without Eigen, since a header of a VTK class includes it. */
#ifndef novelview_TextureAtlasOptions_h
#define novelview_TextureAtlasOptions_h

#include "texture/TextureOptions.h"

namespace novelview
{
struct TextureAtlasOptions
{
  /** Of the picture, at most; the charts are scaled down to fit. */
  static constexpr Parameter<int> LargestSidePxParameter{ 4096, 64, 16384, "px" };
  int LargestSidePx = LargestSidePxParameter.Default;
  int PaddingPx = 4;        ///< around every chart, filled with its border's colours
  double Loyalty = 0.15;    ///< what a neighbour in the same photograph is worth, against quality 1
  int SmoothingRounds = 10; ///< of the choice of photographs, at most
  /**
   * For no particular novel camera: softer than TextureView(), and with equal exposures. Seen along
   * the normal, photographs may be far aside; a high power would count none as seeing a surface.
   */
  static constexpr double MaxPower = 4;
  TextureOptions Texture{ .Power = MaxPower,
    .FeatherPx = 20,
    .OcclusionPx = 1.5,
    .UseGains = true };
};
}

#endif
