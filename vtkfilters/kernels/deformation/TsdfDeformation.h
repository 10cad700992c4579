// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_TsdfDeformation_h
#define novelview_TsdfDeformation_h

#include "core/Execution.h"
#include "core/ImageRef.h"
#include "deformation/Deformation.h"
#include "deformation/DeformationOptions.h"
#include "fusion/FusedSilhouette.h"
#include "fusion/TsdfField.h"
#include "geometry/View.h"

#include <vector>

namespace novelview
{
struct TsdfDeformationOptions
{
  /** At most; 0 only measures. */
  int Iterations = IterationsParameter.Default;
  bool LastOnly = false;      ///< tell the listener of the last iteration only
  double ConvergencePx = 0.1; ///< stop when no point moves further, novel pixels or footprints
  double LevelDecay = 0.5;    ///< of the outline's level from iteration to iteration
  double Smoothing = 0.15;    ///< weight alpha of the smoothness of points that are not outline
  FusedSilhouetteOptions Silhouette;
  /**
   * How the depth maps vote where the surface is looked for, and where it is decided whether a ray
   * meets any. A short truncation puts both where they belong to a fraction of a pixel; a longer
   * one, and more of a prior, finds them more steadily.
   */
  FusionOptions Surface{ 3, 0.05, 0.12 };
  FusionOptions Outline{ 2, 0.05, 0.12, 1 };
};

/**
 * The options for depth maps of which half disagree by more than `noise` input pixel footprints
 * (DepthNoise): from about 0.15 for sharp photographs and exact cameras over 1 for masks and cameras
 * that are off to 3 and more where there is little but sensor noise to match. Truncations, the
 * surface's prior, its smoothness and the contour's smoothing grow with it.
 */
TsdfDeformationOptions OptionsForNoise(double noise);

/**
 * The outline step guided by the field: outline points move, in the plane through them parallel to
 * the novel image plane, to the least of
 *
 *     E = min(d, 0)^2   (FieldOutlineEnergy)
 *
 * d the signed distance of the projection to the contour of FusedSilhouette, novel pixels, positive
 * inside. That contour lies inside the mesh's. The points outside it do not go there at once, since
 * over distances longer than an edge the mesh would fold: in iteration k the contour d = -D r^k is
 * gone to, D the largest
 * distance there is to go and r = LevelDecay, or less when the iterations would not suffice, each
 * point by Newton's steps along the gradient of d; triangles that lie beyond it are cut away. The
 * level is 0 as soon as it is within ConvergencePx, and in the last iteration at all events: what
 * lies beyond the contour would show background. A move that would flip a triangle is shortened.
 *
 * Of the paper are the points and how they move (section 2.2), and that the energy is lowered
 * iteration by iteration. Ours are the distance to the fused contour in place of E_s and E_c, and
 * the level. Smoothness is in FusedSilhouette already.
 */
DeformationResult DeformOutlineByField(const TriangleMesh& mesh,
  const std::vector<std::uint8_t>& visible, const std::vector<View>& views, const Camera& novel,
  const TsdfDeformationOptions& options = {}, const DeformationListener& listener = {},
  const Execution& execution = {});

/**
 * The other step guided by the field: every active point moves along its novel ray. Together they go
 * to the least of the sum over the points of
 *
 *     E = beta E_d + (1 - beta) E_vh + alpha E_r   (FieldRayEnergy)
 *
 * E_d is the squared distance in depth to the first zero crossing of the field on the ray. Of points
 * whose ray meets none it is that to the depth of their neighbours, filled in ring by ring from the
 * points that have a crossing; where there are none anywhere around, beta = 0 and E_vh, the squared
 * distance to where the point started (the hull), holds it. E_r is the square of [10], with the
 * camera's axis as V. RayRelaxation lowers the sum in every iteration, until no point moves further
 * than ConvergencePx. Outline points, which are where they belong in the picture, take their depth
 * the same way.
 *
 * Of the paper are the form of the energy [6], the moves along the rays, E_r, and E_vh with the
 * weight that the photographs leave over. Ours are E_d in place of E_s, the squares (there is
 * one minimum, and no search), beta of 0 or 1, E_vh along the ray, and depth in place of the distance
 * along the ray.
 */
DeformationResult DeformNonOutlineByField(const TriangleMesh& mesh,
  const std::vector<std::uint8_t>& active, const std::vector<View>& views, const Camera& novel,
  const TsdfDeformationOptions& options = {}, const DeformationListener& listener = {},
  const Execution& execution = {});
}

#endif
