// SPDX-License-Identifier: GPL-3.0-or-later
// Which Delaunay tetrahedra are inside, and how that solid is made a manifold.
#ifndef novelview_TetLabels_h
#define novelview_TetLabels_h

#include "crust/Poles.h"

namespace novelview
{
/**
 * Labels every tetrahedron inside or outside.
 *
 * First the poles, most certain first (Amenta, Choi, Kolluri 2001, section 5.1). Tetrahedra with a
 * far corner start as outside with evidence 1. A labelled pole passes on evidence: to the other
 * pole of its samples for the opposite side, -cos of the angle between the two at the sample; to
 * the poles of samples that share a Delaunay edge with its own for the same side, the balls'
 * BallAgreement. The priority of a pole with evidence for both sides is their difference less one,
 * of others the evidence itself; priorities within half a thousandth are one, and the last to get
 * there comes first. A pole takes the side for which the cubes of all its evidence sum to more.
 *
 * Differs from the paper: that passes same-side evidence between neighbours in the poles' power
 * diagram (the neighbours of samples are found without it, which takes a fifth of the time), and
 * takes the side of the one strongest piece of evidence (which holes in the sampling can lead
 * astray; the sum weighs all that was heard).
 *
 * Then all others: they join the neighbour whose ball theirs intersects deepest, deepest first (a
 * watershed), so the boundary runs where balls meet at the flattest angle.
 *
 * With normals (one per sample, outward, or null) each sample also gives its poles evidence, the
 * |cos| of the angle between its normal and the direction to the pole.
 */
std::vector<Side> LabelTets(const DelaunayComplex& complex,
  const std::vector<std::array<int, 2>>& polesOfSample, const std::vector<Eigen::Vector3d>* normals,
  const Execution& execution);

/**
 * Turns over pieces of the inside and of the outside (connected through facets) with less than
 * `minimumSamples` vertices, except the largest of each. Returns how many.
 */
int RemoveSmallComponents(
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
int MakeManifold(
  const DelaunayComplex& complex, std::vector<Side>& labels, const Execution& execution = {});

/**
 * Brings samples onto the surface that have only inside or only outside tetrahedra: a tetrahedron
 * with just the facet opposite the sample on the boundary is turned over (Boissonnat 1984), which
 * keeps a manifold and its genus. A sample so deep that the new facets would lean by more than 75
 * degrees stays where it is. Returns the number of samples brought back.
 */
int RecoverSamples(const DelaunayComplex& complex, std::vector<Side>& labels);
}

#endif
