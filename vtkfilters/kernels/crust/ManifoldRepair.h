// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ManifoldRepair_h
#define novelview_ManifoldRepair_h

#include "core/Execution.h"
#include "crust/TetLabels.h"

#include <vector>

namespace novelview
{
/**
 * Turns tetrahedra over until the inside's boundary is a manifold.
 *
 * A sample is regular when the inside tetrahedra around it are connected through facets that
 * contain it, and so are the outside ones. Around an irregular one all pieces of one side but the
 * largest are relabelled, on the side where that costs less volume. No tetrahedron is relabelled
 * more than `MaximumTurns` times and none with a far corner at all, so it ends; what is left then
 * is for the extraction to split. Returns the number of samples left irregular.
 */
int MakeManifold(
  const DelaunayComplex& complex, std::vector<Side>& labels, const Execution& execution = {});
}

#endif
