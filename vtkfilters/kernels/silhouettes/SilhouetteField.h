// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SilhouetteField_h
#define novelview_SilhouetteField_h

#include "geometry/View.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

namespace novelview
{
/**
 * A view as a map from space to the distance to its contour. It sees what is in front of its camera
 * and inside its frame.
 *
 * Distances in the image grow by at most a pixel per pixel that one moves in it, and bilinear
 * sampling is off by up to another: all bounds here include that.
 */
struct ContourView
{
  explicit ContourView(const View& view);

  /** Where a point is in the picture. */
  struct Pixel
  {
    double X;
    double Y;
    double Depth; ///< of the point, world units; nothing else means anything when it is not above 0
    double Inside; ///< distance to the frame's border, pixels, positive inside the frame
  };
  Pixel Project(const Eigen::Vector3d& x) const
  {
    const Eigen::Vector3d p = this->P.leftCols<3>() * x + this->P.col(3);
    const double u = p.x() / p.z();
    const double v = p.y() / p.z();
    return { u, v, p.z(),
      std::min(
        { u + 0.5, v + 0.5, this->Distance.Width - 0.5 - u, this->Distance.Height - 0.5 - v }) };
  }

  /** The contour distance at a pixel, the nearest one of the frame when it is outside. */
  double DistanceAt(const Pixel& pixel) const
  {
    return SampleBilinear(this->Distance, pixel.X, pixel.Y);
  }

  /** How far a ball reaches in the image from its centre's pixel; its depth is above its radius. */
  double RadiusPx(double radius, double depth) const
  {
    return this->Stretch * radius * this->Focal / (depth - radius) + 1;
  }

  /** The inverse: the radius of the largest ball that reaches no further than this; or 0. */
  double RadiusFor(double radiusPx, double depth) const
  {
    const double px = std::max(radiusPx - 1, 0.0);
    return px * depth / (this->Stretch * this->Focal + px);
  }

  Eigen::Matrix<double, 3, 4> P;
  double Focal;
  double Stretch; ///< largest 1/cos of a pixel's angle to the optical axis
  ImageRef<const float> Distance;
};

/**
 * The visual hull as a field over space:
 *
 *     f(x) = min over the views that see x of  d_v(u_v(x)) z_v(x) / f_v
 *
 * with d_v the signed contour distance (pixels, positive inside), so f is a signed length in world
 * units: the hull is f >= 0. A view does not see a point behind its camera or outside its frame;
 * it then does not limit it. A point that no view sees is outside. A box that the field is bounded
 * by limits it like a further view: by the distance to its nearest face, positive inside.
 *
 * Views need ContourDistance. The views (and their pixels) must outlive the field.
 */
class SilhouetteField
{
public:
  SilhouetteField() = default;
  explicit SilhouetteField(
    const std::vector<View>& views, const std::optional<Eigen::AlignedBox3d>& bounds = {});

  /**
   * Makes `field` the one of those views alone that can decide somewhere in a ball: it has the same
   * values there, and its view ids mean nothing.
   */
  void RestrictTo(const Eigen::Vector3d& centre, double radius, SilhouetteField& field) const;

  /** f(x); minus infinity where no view sees x. */
  double Value(const Eigen::Vector3d& x) const;

  /** f(x), and the view that decides it among the views (-1 where no view sees x). */
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
  std::vector<ContourView> Views;
  std::optional<Eigen::AlignedBox3d> Bounds; ///< the box that the field is bounded by
};
}

#endif
