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
  /** In how many steps the mesh goes there; the last one does not depend on it. */
  int Iterations = IterationsParameter.Default;
  bool LastOnly = false; ///< tell the listener of the last iteration only
  FusedSilhouetteOptions Silhouette;
  double Smoothing = 0.15; ///< weight of a point's neighbours against its own surface
  int SmoothingSteps = 3;
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
 * (DepthNoise): from about 0.15 for sharp photographs and exact cameras to 1 and more for masks and
 * cameras that are off. Truncations, the surface's prior and the contour's smoothing grow with it.
 */
TsdfDeformationOptions OptionsForNoise(double noise);

/**
 * The outline step guided by the field: outline points move in the plane through them parallel to
 * the novel image plane onto the contour of FusedSilhouette. In iteration i of n the contour at
 * level (i/n - 1) D is gone to, D the largest distance there is to go. The strip the outline sweeps
 * is cut away: over distances longer than an edge it would fold. A move that would flip a triangle
 * is shortened.
 *
 * Energy: Photo = distance to the fused contour, pixels.
 */
DeformationResult DeformOutlineByField(const TriangleMesh& mesh,
  const std::vector<std::uint8_t>& visible, const std::vector<View>& views, const Camera& novel,
  const TsdfDeformationOptions& options = {}, const DeformationListener& listener = {},
  const Execution& execution = {});

/**
 * The other step guided by the field: every visible point moves along its novel ray to the first
 * zero crossing of the field, balanced with its neighbours; points whose ray meets none follow
 * their neighbours. Outline points, which are where they belong in the picture, take their depth
 * the same way.
 *
 * Energy: Photo = distance to the crossing, Contour = distance to where the point started (the
 * hull), Smooth = RaySmoothnessEnergy; pixel footprints.
 */
DeformationResult DeformNonOutlineByField(const TriangleMesh& mesh,
  const std::vector<std::uint8_t>& active, const std::vector<View>& views, const Camera& novel,
  const TsdfDeformationOptions& options = {}, const DeformationListener& listener = {},
  const Execution& execution = {});
}

#endif
