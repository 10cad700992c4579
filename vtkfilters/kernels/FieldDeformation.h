// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_FieldDeformation_h
#define novelview_FieldDeformation_h

#include "Deformation.h"
#include "Execution.h"
#include "FusedField.h"
#include "ImageRef.h"
#include "View.h"

#include <vector>

namespace novelview
{
struct FieldDeformationOptions
{
  int Iterations =
    10;               ///< in how many steps the mesh goes there; the last one does not depend on it
  double StepPx = 2;  ///< of the walk along the novel rays, input pixel footprints
  int RimSamples = 3; ///< sub-rays per pixel side where the silhouette's rim is decided
  double Smoothing = 0.15; ///< weight of a point's neighbours against its own surface
  int SmoothingSteps = 3;
  /**
   * How the depth maps vote where the surface is looked for, and where it is decided whether a ray
   * meets any. A short truncation puts the outline where it belongs to a fraction of a pixel; a
   * longer one finds the surface more steadily.
   */
  FusionOptions Surface{ 5, 0.1, 0.12 };
  FusionOptions Outline{ 3, 0.05, 0.12 };
};

/**
 * The silhouette that the fused field shows to the novel camera, inside that of the mesh: signed
 * distance to its contour in novel pixels, positive inside.
 *
 * Every pixel of the mesh's silhouette is object when the field along its ray says so
 * (FusedField::Walk); pixels at the rim are decided by sub-rays; then a 3x3 median, tiny holes
 * filled, tiny islands dropped.
 */
Image<float> FusedSilhouette(const TriangleMesh& mesh, const FusedField& field, const Camera& novel,
  double footprint, const FieldDeformationOptions& options, const Execution& execution = {});

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
  const FieldDeformationOptions& options = {}, const DeformationListener& listener = {},
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
  const FieldDeformationOptions& options = {}, const DeformationListener& listener = {},
  const Execution& execution = {});
}

#endif
