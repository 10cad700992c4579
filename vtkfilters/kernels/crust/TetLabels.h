// SPDX-License-Identifier: GPL-3.0-or-later
// The side of the surface that each Delaunay tetrahedron is on.
#ifndef novelview_TetLabels_h
#define novelview_TetLabels_h

#include "crust/DelaunayComplex.h"

#include <vector>

namespace novelview
{
/** On which side of the surface a ball or a tetrahedron is. */
enum class Side : char
{
  Unknown,
  Inside,
  Outside
};

/** The other one of the two sides. */
inline Side Opposite(Side side)
{
  return side == Side::Inside ? Side::Outside : Side::Inside;
}

/** Whether all tetrahedra of a sample are on one side; false when it has none. */
bool IsInterior(const DelaunayComplex& complex, const std::vector<Side>& labels, int sample);
}

#endif
