// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_TsdfField_h
#define novelview_TsdfField_h

#include "fusion/FusionOptions.h"
#include "fusion/TsdfView.h"
#include "geometry/View.h"

#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace novelview
{
class TsdfRay;

/**
 * The depth maps of all reference views fused as a signed distance. At a point X each view with a
 * depth D at its projection votes s = D - z(X): nothing when s < -tau (X is hidden from it), else
 * min(1, s / tau) with the confidence G of that depth. With F = sum G min(1, s/tau), W = sum G,
 *
 *     field(X) = (F - w0) / (W + w0)
 *
 * is positive in free space and negative in the solid; where nobody sees anything it is solid. A
 * point outside any silhouette is free, and so is one outside the box around the surfaces that the
 * maps show: far behind the object there are places that no frame covers. (Curless and Levoy 1996,
 * evaluated where it is asked for instead of on a grid.)
 *
 * Views need ContourDistance, DepthMap and Confidence and must outlive the field.
 */
class TsdfField
{
public:
  TsdfField(const std::vector<View>& views, const FusionOptions& options, double footprint);

  /**
   * The field of these views, as if there were no others: these neither vote nor does it count what
   * lies outside their silhouettes. Only the box stays that of all.
   */
  TsdfField Of(const std::vector<int>& views) const;

  /** Sums F and W at a point; false when it is outside a silhouette, that is, free. */
  bool Accumulate(const Eigen::Vector3d& x, double& f, double& w) const;

  /** What a ray meets. */
  struct RayResult
  {
    std::optional<double> Surface; ///< depth-like parameter of the first point with field <= 0
    double Min = 1;                ///< least of (F - wm) / (W + wm) over the ray: below 0 = object
  };

  /**
   * Walks origin + t direction from `from` to `to` in steps of `step`, and refines the first
   * crossing. Stops at the crossing when the ray is certainly object by then.
   */
  RayResult FindFirstCrossing(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
    double from, double to, double step) const;

  /** What maps and silhouettes say about a point, input pixel footprints, within +- tau. */
  struct LatticeSample
  {
    float Distance; ///< tau * field, with votes that fade behind the surface (TsdfView)
    float Weight;   ///< W + w0
    float Outside;  ///< signed distance to the silhouettes' contours, above 0 = outside
  };

  /** Samples `count` points, origin + n step. */
  void SampleRow(const Eigen::Vector3d& origin, const Eigen::Vector3d& step, int count,
    LatticeSample* samples) const;

  /** How far a ray passes from the object. */
  struct ClosestApproach
  {
    /** Signed distance of the ray from the surface, input pixel footprints, within +- tau: above 0 =
     * misses. */
    double SignedDistance;
    double At; ///< parameter of the ray where it comes nearest, or is deepest inside
  };

  /**
   * The least signed distance along the ray, which is the larger of two at each of its points: that
   * to the silhouettes' contours, and tau (F - wm) / (W + wm) of the maps. The latter is noisy, and
   * the least of many noisy values is biased; it is therefore smoothed along the ray by a parabola
   * through five samples (Savitzky and Golay 1964), which leaves round shapes as they are.
   */
  ClosestApproach FindClosestApproach(const Eigen::Vector3d& origin,
    const Eigen::Vector3d& direction, double from, double to, double step) const;

  /**
   * The least SilhouettePrior with which the ray counts as object; stops looking once it is no more
   * than `enough`. Infinity when the ray leaves the silhouettes without meeting anything.
   */
  double PriorNeeded(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double from,
    double to, double step, double enough) const;

private:
  /** How much more the prior weighs after this length of ray inside every silhouette. */
  double ChordFactor(double inside) const;
  bool Accumulate(const TsdfRay& ray, double& f, double& w) const;
  double Value(const TsdfRay& ray) const;
  /** What silhouettes and maps say about a point of a ray. */
  struct Sample
  {
    double Outside; ///< how far outside the silhouettes, footprints, within +- tau
    double F, W;    ///< the maps' votes; not complete when Outside is tau
    int FreeSteps;  ///< so many further steps of the ray are tau or more outside, too
  };
  Sample SampleAt(const TsdfRay& ray, const Eigen::Vector3d& step) const;
  /** Shortens [from, to] of a ray to what lies in the box around the maps' surfaces. */
  void ClipToBounds(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double& from,
    double& to) const;

  std::vector<TsdfView> Views;
  Eigen::AlignedBox3d Bounds;
  FusionOptions Options;
  double Tau;
  double Footprint;
};
}

#endif
