// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_TextureAtlasOptions_h
#define novelview_TextureAtlasOptions_h

#include "texture/TextureOptions.h"

namespace novelview
{
struct TextureAtlasOptions
{
  int LargestSidePx = 4096; ///< of the picture; the charts are scaled down to fit. [64, 32768]
  int PaddingPx = 4;        ///< around every chart, filled with its border's colours
  double Loyalty = 0.15;    ///< what a neighbour in the same photograph is worth, against quality 1
  int SmoothingRounds = 10; ///< of the choice of photographs, at most
  TextureOptions Texture{ 3, 16, 20, 1.5, 1.5, false, true, 1 };
};
}

#endif
