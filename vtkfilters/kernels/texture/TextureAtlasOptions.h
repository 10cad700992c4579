// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_TextureAtlasOptions_h
#define novelview_TextureAtlasOptions_h

#include "texture/TextureOptions.h"
#include "texture/TextureParameters.h"

namespace novelview
{
struct TextureAtlasOptions
{
  /** Of the picture, at most; the charts are scaled down to fit. */
  int LargestSidePx = TextureAtlasParameters::LargestSidePx.Default;
  int PaddingPx = 4;        ///< around every chart, filled with its border's colours
  double Loyalty = 0.15;    ///< what a neighbour in the same photograph is worth, against quality 1
  int SmoothingRounds = 10; ///< of the choice of photographs, at most
  TextureOptions Texture{ .References = TextureAtlasParameters::References.Default,
    .Power = TextureAtlasParameters::Power.Default,
    .FeatherPx = TextureAtlasParameters::FeatherPx.Default,
    .OcclusionPx = TextureAtlasParameters::OcclusionPx.Default,
    .UseGains = TextureAtlasParameters::UseGains };
};
}

#endif
