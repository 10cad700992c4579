// SPDX-License-Identifier: GPL-3.0-or-later
// Which Delaunay tetrahedra are inside, and how that solid is made a manifold.
#ifndef novelview_TetLabels_h
#define novelview_TetLabels_h

#include "PoleLabels.h"

namespace novelview
{
/**
 * Gives every tetrahedron a side. Those of labelled poles have theirs, those with a far corner are
 * outside; the others join, most certain first, the neighbour they agree with best: a watershed
 * over facets with BallAgreement as height, so the boundary runs where balls meet at the flattest
 * angle. Ties: lowest tetrahedron id.
 */
std::vector<Side> LabelTets(
  const DelaunayComplex& complex, const Poles& poles, const std::vector<Side>& poleLabels);

/**
 * Turns over pieces of the inside and of the outside (connected through facets) with less than
 * `minimumSamples` vertices, except the largest of each. Returns how many.
 */
int RemoveSmallPieces(
  const DelaunayComplex& complex, int minimumSamples, std::vector<Side>& labels);

/**
 * Turns tetrahedra over until the inside's boundary is a manifold.
 *
 * A sample is regular when the inside tetrahedra around it are connected through facets that
 * contain it, and so are the outside ones. Around an irregular one all pieces of one side but the
 * largest are turned over, on the side where that costs less volume. No tetrahedron is turned more
 * than `MaximumTurns` times and none with a far corner at all, so it ends; what is left then is
 * for the extraction to split. Returns the number of samples left irregular.
 */
int MakeManifold(const DelaunayComplex& complex, std::vector<Side>& labels);

/**
 * Brings samples onto the surface that have only inside or only outside tetrahedra: a tetrahedron
 * with just the facet opposite the sample on the boundary is turned over (Boissonnat 1984), which
 * keeps a manifold and its genus. A sample so deep that the new facets would lean by more than 75
 * degrees stays where it is. Returns the number of samples brought back.
 */
int RecoverSamples(const DelaunayComplex& complex, std::vector<Side>& labels);
}

#endif
