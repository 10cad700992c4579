// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MatchImage_h
#define novelview_MatchImage_h

#include "core/ImageRef.h"
#include "geometry/Camera.h"
#include "geometry/View.h"

#include <cstdint>

namespace novelview
{
/** A photograph ready for matching: colour and luma of the object, everything else 0. */
struct MatchImage
{
  Camera Cam;
  Image<std::uint8_t> Pixels; ///< R, G, B, luma; luma 0 = background, at least 1 on the object
};

/**
 * Packs a view, reduced by an integer factor (box mean over the object's pixels; a pixel is object
 * when half of what it covers is).
 */
MatchImage MakeMatchImage(const View& view, int reduction);
}

#endif
