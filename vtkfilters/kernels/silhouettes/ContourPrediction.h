// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ContourPrediction_h
#define novelview_ContourPrediction_h

#include "geometry/View.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace novelview
{
struct ContourPredictionOptions
{
  double MaxAngleDeg = 70;   ///< photographs are used whose tangent plane is turned by no more
  double MaxTilt = 0.2;      ///< and leaves the plane of viewing ray and normal by no more (sine)
  double MaxDistancePx = 40; ///< and in which the point is no further from the contour
  int PerSide = 2;           ///< this many nearest ones on either side of the novel view
};

struct PredictedContour
{
  double Distance; ///< of the point from the predicted contour, world units, above 0 = outside
  double Radius;   ///< of the surface's curvature across the contour, world units
  double Residual; ///< root mean square misfit of the circle, world units
};

/**
 * Where the object's contour passes near a point on a novel ray, interpolated from the photographs'
 * contours on both sides.
 *
 * Between two neighbouring cameras the hull's cross-section is a polygon around the object's; the
 * object itself touches each camera's tangent plane. Across the contour the surface is taken for a
 * circle of radius R >= 0 (R = 0: a sharp edge) with its foremost point h0 off the novel ray and b
 * along it; a tangent plane that is turned by theta then lies
 *
 *     h(theta) = R (1 - cos theta) + h0 cos theta + b sin theta
 *
 * from the point. R, h0 and b are fitted to the distances of the point from the nearest photographs'
 * contours by weighted least squares. This is the support function of the osculating circle that
 * Cipolla and Blake (1992) reconstruct from three consecutive contours.
 *
 * @param views need ContourDistance.
 * @param point on the novel ray, near the object's contour.
 * @param ray unit direction of the novel ray.
 * @param normal unit normal of the novel contour, orthogonal to the ray, pointing out.
 * Nothing when there are not three photographs, some on either side.
 */
std::optional<PredictedContour> PredictContour(const std::vector<View>& views,
  const Eigen::Vector3d& point, const Eigen::Vector3d& ray, const Eigen::Vector3d& normal,
  const ContourPredictionOptions& options = {});
}

#endif
