// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_FieldEnergy_h
#define novelview_FieldEnergy_h

#include "core/ImageRef.h"
#include "deformation/Deformation.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace novelview
{
/**
 * The energy of an outline point: the squared distance by which its projection lies outside the fused
 * contour, pixels squared, as Photo and as Total. Within, it is 0: the outline is as wide as a pixel,
 * so that some of its points lie a little inside.
 *
 * @param contourDistance signed distance to the contour, novel pixels, positive inside
 * (FusedSilhouette).
 */
PointEnergy FieldOutlineEnergy(
  const Image<float>& contourDistance, const Eigen::Vector2d& projection);

/** What the energy of a point on its novel ray is made of; depths in the novel camera. */
struct RayPoint
{
  Eigen::Vector3d Position;
  double Depth;                  ///< of it
  double Start;                  ///< where it was: on the hull
  std::optional<double> Surface; ///< where its ray meets the field's surface
};

/**
 * The energy of any other point, all terms in pixel footprints squared:
 *
 *     E = beta E_d + (1 - beta) E_vh + alpha E_r
 *
 * Photo = E_d = (Surface - Depth)^2, 0 without a surface; Contour = E_vh = (Start - Depth)^2;
 * Smooth = E_r = RaySmoothnessEnergy()^2 along the camera's axis. beta is 1 with a surface, else 0.
 */
PointEnergy FieldRayEnergy(const RayPoint& point, const Eigen::Vector3d& axis,
  const std::vector<Eigen::Vector3d>& neighbours, double alpha, double footprint);
}

#endif
