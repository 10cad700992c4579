// SPDX-License-Identifier: GPL-3.0-or-later
/** Which place of the pixels' centres the silhouettes agree with. */
#ifndef novelview_PixelCentres_h
#define novelview_PixelCentres_h

#include "core/Execution.h"
#include "geometry/View.h"

#include <vector>

namespace novelview
{
/** How silhouettes agree when all principal points are shifted along the pixels' diagonal. */
struct PixelCentreVerdict
{
  std::vector<double>
    LossPx;          ///< per shift: mean over the contour rays of how far they miss the hull
  double Sigmas = 0; ///< by how many standard errors (over the views) the second shift is better
                     ///< than the first
};

/** Measures that for each of the shifts, px of the photographs; at least two. */
PixelCentreVerdict ComparePixelCentres(const std::vector<View>& views,
  const std::vector<double>& shiftsPx, const Execution& execution = {});
}

#endif
