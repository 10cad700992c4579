// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SmallComponents_h
#define novelview_SmallComponents_h

#include "crust/TetLabels.h"

#include <vector>

namespace novelview
{
/**
 * Turns over pieces of the inside and of the outside (connected through facets) with less than
 * `minimumSamples` vertices, except the largest of each. Returns how many.
 */
int RemoveSmallComponents(
  const DelaunayComplex& complex, int minimumSamples, std::vector<Side>& labels);
}

#endif
