// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_GrabCutMask_h
#define novelview_GrabCutMask_h

#include "core/ImageRef.h"
#include "masks/Silhouette.h"

#include <array>
#include <cstdint>

namespace novelview
{
struct GrabCutOptions
{
  std::array<double, 4> Box{ 0, 0, 0, 0 }; ///< x0 y0 x1 y1, pixels; the object lies inside
  int Rounds = 5;
  double SmallHole =
    SilhouetteOptions().SmallHole; ///< holes smaller than this part of the object are filled
};

/** The box that leaves out this part of the frame to every side. */
std::array<double, 4> CentralBox(int width, int height, double margin);

/**
 * The silhouette of the object in a box, before any background that also surrounds the box: GrabCut
 * (Rother, Kolmogorov and Blake 2004) as implemented in OpenCV, on a copy of at most 640 pixels, of
 * which the largest component is kept. The same on every run. One channel, 255 inside, 0 outside,
 * in between at the boundary of what was enlarged.
 *
 * Throws Error when less than 16 pixels of the frame are in the box or outside of it, or when
 * nothing in it differs from what surrounds it.
 */
Image<std::uint8_t> GrabCutSilhouette(
  const ImageRef<const std::uint8_t>& photo, const GrabCutOptions& options);
}

#endif
