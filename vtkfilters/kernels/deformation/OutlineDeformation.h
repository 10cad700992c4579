// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OutlineDeformation_h
#define novelview_OutlineDeformation_h

#include "core/Execution.h"
#include "deformation/Deformation.h"
#include "deformation/DeformationOptions.h"
#include "deformation/Membrane.h"
#include "geometry/View.h"

#include <vector>

namespace novelview
{
/**
 * Moves the outline points of a mesh: the visible points whose projection lies on the contour of
 * the model's own silhouette in the novel view. Each looks along its direction, in the plane
 * through it parallel to the novel image plane, both ways, for the candidate with the least
 *
 *     E = E_s + Alpha E_c + Beta E_r   [1]
 *
 * The paper leaves open which photographs can tell. A point of the outline is seen by the cameras on
 * its moving side only, so E_s compares those: the key is the one of them nearest the novel view,
 * the secondaries its neighbours among them. Points that fewer than two see, and flat windows, tell
 * nothing. A minimum must be distinct (Margin, MaxPhoto, Rise); of the moves so found each point
 * takes the median of its own and its outline neighbours', as points of one smooth outline.
 *
 * The points behind the outline follow as a membrane (the paper's own picture of the mesh). All moves
 * of an iteration are taken back and halved while they do not lower the mean energy; when that does
 * not help, or the largest move is under ConvergencePx, the iterations end.
 *
 * Triangles that face away from the novel camera are dropped first.
 *
 * @param visible per point, 1 = visible; empty = all.
 */
DeformationResult DeformOutline(const TriangleMesh& mesh, const std::vector<std::uint8_t>& visible,
  const std::vector<View>& views, const Camera& novel, const OutlineOptions& options = {},
  const DeformationListener& listener = {}, const Execution& execution = {});
}

#endif
