// SPDX-License-Identifier: GPL-3.0-or-later
// Private to crust.
#ifndef novelview_Circumsphere_h
#define novelview_Circumsphere_h

#include "crust/DelaunayComplex.h"

namespace novelview
{
/**
 * Sets Centres[tet] and Radii[tet], world units, to the circumsphere of a tetrahedron. Of a flat one
 * the centre is the circumcentre of its largest facet.
 */
void ComputeCircumsphere(DelaunayComplex& complex, int tet);
}

#endif
