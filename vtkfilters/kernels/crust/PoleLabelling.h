// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PoleLabelling_h
#define novelview_PoleLabelling_h

#include "core/Execution.h"
#include "crust/TetLabels.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace novelview
{
/**
 * Labels the poles inside or outside. Returns a label per tetrahedron, unknown for those that are
 * neither poles nor touch a far corner.
 *
 * The most certain pole comes first (Amenta, Choi, Kolluri 2001, section 5.1). Tetrahedra with a
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
 * With normals (one per sample, outward, or null) each sample also gives its poles evidence, the
 * |cos| of the angle between its normal and the direction to the pole.
 */
std::vector<Side> LabelPoles(const DelaunayComplex& complex,
  const std::vector<std::array<int, 2>>& polesOfSample, const std::vector<Eigen::Vector3d>* normals,
  const Execution& execution);
}

#endif
