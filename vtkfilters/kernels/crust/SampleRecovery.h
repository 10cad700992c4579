// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SampleRecovery_h
#define novelview_SampleRecovery_h

#include "crust/TetLabels.h"

#include <vector>

namespace novelview
{
/**
 * Brings samples onto the surface that have only inside or only outside tetrahedra: a tetrahedron
 * with just the facet opposite the sample on the boundary is relabelled (Boissonnat 1984), which
 * keeps a manifold and its genus. A sample so deep that the new facets would lean by more than 75
 * degrees stays where it is. Returns the number of samples brought back.
 */
int RecoverSamples(const DelaunayComplex& complex, std::vector<Side>& labels);
}

#endif
