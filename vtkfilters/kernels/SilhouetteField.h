// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SilhouetteField_h
#define novelview_SilhouetteField_h

#include "View.h"

#include <Eigen/Geometry>

#include <limits>
#include <vector>

namespace novelview
{
/**
 * The visual hull as a field over space:
 *
 *     f(x) = min over the views that see x of  d_v(u_v(x)) z_v(x) / f_v
 *
 * with d_v the signed contour distance (pixels, positive inside), so f is a signed length in world
 * units: the hull is f >= 0. A view does not see a point behind its camera or outside its frame;
 * it then says nothing about it. A point no view sees is outside.
 *
 * Views need ContourDistance. The views (and their pixels) must outlive the field.
 */
class SilhouetteField
{
public:
  explicit SilhouetteField(const std::vector<View>& views);

  /** f(x); minus infinity where no view sees x. */
  double Value(const Eigen::Vector3d& x) const;

  /** f(x), and the view that decides it (-1 where no view sees x). */
  double Value(const Eigen::Vector3d& x, int& decidingView) const;

  /** Central differences with the given step, world units. Points inwards. */
  Eigen::Vector3d Gradient(const Eigen::Vector3d& x, double step) const;

  /** How a ball lies to the hull; Mixed whenever that is not certain. */
  enum class Position
  {
    Outside,
    Inside,
    Mixed
  };
  Position Classify(const Eigen::Vector3d& centre, double radius) const;

private:
  struct Projector
  {
    Eigen::Matrix<double, 3, 4> P;
    double Focal;
    double Stretch; ///< largest 1/cos of a pixel's angle to the optical axis
    ImageRef<const float> Distance;
  };
  std::vector<Projector> Projectors;
};
}

#endif
