// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OutlineDeformation_h
#define novelview_OutlineDeformation_h

#include "core/Execution.h"
#include "deformation/Deformation.h"
#include "deformation/DeformationParameters.h"
#include "deformation/Membrane.h"
#include "geometry/View.h"

#include <vector>

namespace novelview
{
struct OutlineOptions
{
  /** Weight of the contour energy. */
  double Alpha = OutlineParameters::Alpha.Default;
  /** Weight of the smoothness energy. */
  double Beta = OutlineParameters::Beta.Default;
  /** At most; 0 only measures. */
  int Iterations = DeformationParameters::Iterations.Default;

  // ---- the search
  /** How far to either side candidates lie, novel pixels. */
  double SearchPx = OutlineParameters::SearchPx.Default;
  double StepPx = 0.5;        ///< spacing of the candidates, novel pixels
  double MaxMovePx = 1.5;     ///< how far a point goes in the first iteration, novel pixels
  double MoveDecay = 0.8;     ///< of MaxMovePx from iteration to iteration
  double ConvergencePx = 0.1; ///< stop when no point moves further

  // ---- the terms
  /** Of the photo-consistency windows, input pixels. */
  int WindowRadius = OutlineParameters::WindowRadius.Default;
  int Secondaries = 2;     ///< the key's neighbours, at most
  double MinFacing = 0.4;  ///< a view that is compared lies so far on the moving side, cosine
  double MaxApartDeg = 62; ///< and a secondary no further from the key
  double BehindPx = 3;     ///< and the model hides the point by no more, input pixel footprints
  /** Sigma of the contour energy, input pixels. */
  double SigmaPx = OutlineParameters::SigmaPx.Default;
  int NearViews = 2;        ///< views of the contour energy, at most
  double NearAngleDeg = 45; ///< and no further from the novel view than this

  // ---- when a minimum counts
  double MinVariance = 60;    ///< of the key window, grey levels squared; flatter ones say nothing
  double Margin = 0.05;       ///< the energy must fall by more
  double MaxPhoto = 0.2;      ///< E_s there is no more,
  double MaxPhotoShare = 0.5; ///< nor more than this part of what it is where the point is
  double Rise = 0.05;         ///< and the energy rises by more to both sides,
  double RisePx = 6;          ///< within this, novel pixels

  MembraneOptions Membrane;
};

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
