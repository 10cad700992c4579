// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ContourDistance_h
#define novelview_ContourDistance_h

#include "core/ImageRef.h"

#include <cstdint>

namespace novelview
{
/**
 * Signed distance, in pixels, from every pixel centre to the contour of a silhouette; positive
 * inside. One channel, the size of the mask.
 *
 * The contour is the 0.5 crossing of the mask (127.5 of 255) and is located to sub-pixel accuracy.
 * The mask may be binary or contain grey coverage at its boundary. Between two neighbouring pixels
 * of which one is object and one is not, the crossing is
 *
 *  - where the area under the coverage puts it, when the line through both falls monotonically from
 *    full to empty within three pixels either way: exact for a straight edge seen through any
 *    symmetric pixel filter, and the common side of the two pixels when the mask is binary;
 *  - the linear interpolation of the two otherwise (thin features, the frame).
 *
 * The crossings are joined by marching squares, and the distance is the one to the nearest of those
 * segments.
 *
 * Nothing outside the frame counts: there is no contour along the frame. A mask without contour
 * gives plus (full) or minus (empty) the frame's diagonal everywhere.
 */
Image<float> SignedContourDistance(const ImageRef<const std::uint8_t>& mask);
}

#endif
