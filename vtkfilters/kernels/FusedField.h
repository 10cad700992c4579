// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_FusedField_h
#define novelview_FusedField_h

#include "View.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace novelview
{
struct FusionOptions
{
  double TruncationPx = 5;      ///< tau, input pixel footprints
  double SurfacePrior = 0.15;   ///< w0: weight of "solid" when the surface is located
  double SilhouettePrior = 0.2; ///< w0m: the same when it is decided whether there is any
};

/**
 * The depth maps of all reference views fused as a signed distance. At a point X each view with a
 * depth D at its projection votes s = D - z(X): nothing when s < -tau (X is hidden from it), else
 * min(1, s / tau) with the confidence G of that depth. With F = sum G min(1, s/tau), W = sum G,
 *
 *     field(X) = (F - w0) / (W + w0)
 *
 * is positive in free space and negative in the solid; where nobody sees anything it is solid. A
 * point outside any silhouette is free. (Curless and Levoy 1996, evaluated where it is asked for
 * instead of on a grid.)
 *
 * Views need ContourDistance, DepthMap and Confidence and must outlive the field.
 */
class FusedField
{
public:
  FusedField(const std::vector<View>& views, const FusionOptions& options, double footprint);

  /** Sums F and W at a point; false when it is outside a silhouette, that is, free. */
  bool Vote(const Eigen::Vector3d& x, double& f, double& w) const;

  /** What a ray meets. */
  struct RayResult
  {
    std::optional<double> Surface; ///< depth-like parameter of the first point with field <= 0
    double Least = 1;              ///< least of (F - wm) / (W + wm) over the ray: below 0 = object
  };

  /**
   * Walks origin + t direction from `from` to `to` in steps of `step`, and refines the first
   * crossing. Stops at the crossing when the ray is certainly object by then.
   */
  RayResult Walk(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double from,
    double to, double step) const;

  /**
   * The least SilhouettePrior with which the ray counts as object; stops looking once it is no more
   * than `enough`. Infinity when the ray leaves the silhouettes without meeting anything.
   */
  double PriorNeeded(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double from,
    double to, double step, double enough) const;

private:
  /** How much more the prior weighs after this length of ray inside every silhouette. */
  double ChordFactor(double inside) const;
  struct Voter
  {
    Eigen::Matrix<double, 3, 4> P;
    const View* From;
  };
  double Value(const Eigen::Vector3d& x) const;

  std::vector<Voter> Voters;
  FusionOptions Options;
  double Tau;
  double Footprint;
};
}

#endif
