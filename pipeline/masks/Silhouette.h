// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Silhouettes from photographs. The signed distance to a silhouette's contour is
 * SignedContourDistance() of the kernels.
 */
#ifndef novelview_Silhouette_h
#define novelview_Silhouette_h

#include "core/ImageRef.h"

#include <array>
#include <cstdint>
#include <optional>

namespace novelview
{
/** How the object is distinguished from a plain background. */
struct SilhouetteOptions
{
  /** Difference from the background's colour (largest of the three channels, 0 to 255) from which
   * a pixel is object. Chosen from the photograph when not given. */
  std::optional<double> Level;
  /** Gaps of up to twice this many pixels are closed. */
  int ClosingPx = 2;
  /** Holes smaller than this part of the object's area are filled; larger ones are real. A dark
   * crevice taken for a hole carves the object, a filled hole only leaves it to other views. */
  double SmallHole = 0.01;
  /** Take darker shades of a clearly coloured background for shadows the object casts on it. */
  bool IgnoreShadows = true;
  /** What is known of the background. */
  enum class Backdrop
  {
    Plain, ///< one colour, found along the border
    Dark,  ///< dark (below 64 of 255), even where most of the border is object
    Chroma ///< one clear hue; the object differs by its hue, whatever the light on either
  };
  Backdrop Background = Backdrop::Plain;
  /** RGB of a Chroma background, 0 to 255; found along the border when not given. */
  std::optional<std::array<double, 3>> Key;
};

/**
 * The silhouette of the one object in a photograph (3 channels, RGB) before a plain dark or plain
 * coloured background. One channel: 255 inside, 0 outside, the coverage in between at the
 * silhouette boundary.
 *
 *  1. Background colour: the most frequent colour along the image's border, so the object may
 *     leave the frame.
 *  2. Difference of every pixel from it. Before a coloured background, what differs only by being
 *     darker is shadow and does not count.
 *  3. Without a level two are chosen: Otsu's, above which is surely object, and a lower one; what
 *     is above that and connected to surely object is object, so that parts in shadow are kept.
 *     The lower one is that whose outline follows the edges of the image best, so that folds and
 *     lights of a backdrop are left out.
 *  4. Closing, the largest component, small holes filled.
 *  5. The boundary is moved to where the difference is half of that just inside of it, since a bright
 *     object's blur is brighter than any low level.
 *  6. Before a dark background, large regions next to the object that differ from it only when
 *     smoothed are added: parts in deep shadow. Not so regions along the frame: a backdrop.
 *
 * Parts of the object no brighter than a dark background cannot be distinguished from it; give
 * masks then. A photograph without any difference gives an empty silhouette.
 *
 * With a Chroma background the difference (2.) is that of the colours without their luma (the Cb
 * and Cr of JPEG, times two) from the nearest shade of the key. Throws Error when the key has no
 * hue, or when nothing along the border is dark with a Dark background.
 */
Image<std::uint8_t> ExtractSilhouette(
  const ImageRef<const std::uint8_t>& photo, const SilhouetteOptions& options = {});
}

#endif
