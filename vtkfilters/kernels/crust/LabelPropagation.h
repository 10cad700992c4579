// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_LabelPropagation_h
#define novelview_LabelPropagation_h

#include "core/Execution.h"
#include "crust/TetLabels.h"

#include <vector>

namespace novelview
{
/**
 * Lets labels spread over facets to all tetrahedra that have none: each joins the neighbour whose
 * ball its own intersects deepest, deepest first (a watershed), so the boundary runs where balls
 * meet at the flattest angle.
 *
 * That is the strongest spanning forest whose trees each hold one tetrahedron with a label
 * (Boruvka): every region without one joins the region it is most strongly connected with.
 */
void PropagateLabels(
  const DelaunayComplex& complex, std::vector<Side>& labels, const Execution& execution);
}

#endif
