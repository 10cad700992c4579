// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SemiGlobal_h
#define novelview_SemiGlobal_h

#include "core/Execution.h"
#include "core/ImageRef.h"
#include "stereo/CostVolume.h"
#include "stereo/ReferenceDepthOptions.h"

#include <cstdint>

namespace novelview
{
/**
 * Semi-global matching (Hirschmueller 2008): adds up the least costs along eight directions.
 * Returns the sums in a volume of the same shape.
 */
CostVolume AggregateSemiGlobally(const CostVolume& volume, const Image<float>& base,
  const SemiGlobalOptions& options, const Execution& execution = {});

/**
 * Depth per pixel of the frame from the least aggregated cost, refined by a parabola through it and
 * its two neighbours; 0 where there is no base. `winner` receives the label (unrefined) per pixel.
 */
Image<float> WinnerTakesAll(
  const CostVolume& aggregated, const Image<float>& base, Image<std::uint8_t>& winner);
}

#endif
