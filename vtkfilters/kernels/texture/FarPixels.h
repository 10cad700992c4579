// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_FarPixels_h
#define novelview_FarPixels_h

#include "core/ImageRef.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace novelview
{
/** How far from a far pixel the photographs that see it are compared with the near ones, pixels. */
constexpr int FarSeamPx = 4;

/** What LevelFarPixels() needs of a picture; all images have its size. */
struct FarPixelInput
{
  ImageRef<const std::uint8_t> Far;  ///< 1 = only from photographs that look from far to the side
  ImageRef<const float> Depth;       ///< z of the surface point
  double FocalLength;                ///< pixels
  ImageRef<const std::uint8_t> Seam; ///< 1 = a near pixel that far photographs see, too
  ImageRef<const float> SeamColor;   ///< the colour that they give it, three channels, grey levels
};

/**
 * Brings the colours of pixels that only photographs far to the side see to the level of those next
 * to them. A surface in the shade that only they see may be in the light there, where the lamps do
 * not turn with the object. Along the seam both kinds of photographs see the same points; the ratio
 * of their colours continues smoothly into the far region (gradient-domain blending, Perez, Gangnet
 * and Blake 2003): colours are multiplied by exp(d), d the least of
 *
 *     sum over neighbours p, q of (d_p - d_q)^2
 *   + sum over p of the seam of w (d_p - log(near colour / far colour))^2,
 *
 * a colour being the sum of its channels. Neighbours are the four around a pixel that lie on the
 * same surface, not across a jump in depth. Regions without a seam keep their colours.
 *
 * @param color of the picture, three channels, grey levels.
 */
void LevelFarPixels(const FarPixelInput& input, Image<float>& color);

using PixelList = std::vector<std::pair<int, int>>;

/**
 * The regions of far pixels without a seam that border on unseen pixels and are smaller than these:
 * nothing tells their level, and the unseen pixels must not take it from them.
 *
 * @param unseen 1 = drawn, but no photograph sees it.
 */
std::vector<PixelList> FindFarIslands(
  const FarPixelInput& input, const ImageRef<const std::uint8_t>& unseen);
}

#endif
