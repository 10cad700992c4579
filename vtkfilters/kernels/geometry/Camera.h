// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Camera_h
#define novelview_Camera_h

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <string>

namespace novelview
{
/**
 * A calibrated pinhole camera, and the one place where the project's conventions are stated:
 *
 *  - World unit = calibration unit.
 *  - Camera frame: x right, y down, z forward.  x_cam = R x_world + T,  centre C = -R' T.
 *  - Pixel: u ~ K x_cam. Pixel centres are integers, (0,0) is the centre of the top-left pixel, so
 *    the frame covers [-0.5, Width - 0.5) x [-0.5, Height - 0.5).
 *  - Depth = z in the camera frame (not the distance along the ray).
 *
 * Data in any other convention is converted by its reader.
 */
struct Camera
{
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d T = Eigen::Vector3d::Zero();
  int Width = 0;
  int Height = 0;

  Eigen::Vector3d Centre() const { return -(this->R.transpose() * this->T); }
  Eigen::Vector3d OpticalAxis() const { return this->R.row(2).transpose(); }
  Eigen::Vector3d ToCamera(const Eigen::Vector3d& pointInWorld) const
  {
    return this->R * pointInWorld + this->T;
  }
  double Depth(const Eigen::Vector3d& pointInWorld) const
  {
    return this->R.row(2).dot(pointInWorld) + this->T.z();
  }
  /** Pixel of a world point. The point must lie in front of the camera (Depth > 0). */
  Eigen::Vector2d Project(const Eigen::Vector3d& pointInWorld) const
  {
    return (this->K * this->ToCamera(pointInWorld)).hnormalized();
  }
  /** World point at a pixel and a depth. */
  Eigen::Vector3d Unproject(const Eigen::Vector2d& pixel, double depth) const;
  /** Unit direction in the world from the centre through a pixel. */
  Eigen::Vector3d RayDirection(const Eigen::Vector2d& pixel) const;
  /** Mean focal length, pixels. */
  double FocalLength() const { return std::sqrt(std::abs(this->K(0, 0) * this->K(1, 1))); }
  /** World size of one pixel at a depth: z / f. */
  double PixelFootprint(double depth) const { return depth / this->FocalLength(); }
  bool InFrame(const Eigen::Vector2d& pixel) const
  {
    return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < this->Width - 0.5 &&
      pixel.y() < this->Height - 0.5;
  }
};

/**
 * Throws Error when the camera is invalid: numbers not finite, K singular or not of the form
 * [fx s cx; 0 fy cy; 0 0 1] with positive focal lengths, R not a rotation (within 1e-3, which
 * leaves room for calibrations printed with few digits); or when it is implausible, so that
 * computing with it could overflow: with s the larger side of the image, focal lengths outside
 * [s/1000, 10000 s], a principal point beyond 1000 s, |T| beyond 1e12. The size may be unknown:
 * then s is any from 1 to 2^20.
 */
void ValidateCalibration(const Camera& camera, const std::string& where);

/** The same for a camera whose size is known; throws Error when that is not positive, too. */
void ValidateCamera(const Camera& camera, const std::string& where);

/**
 * The camera a fraction of the way from one camera to another on their common orbit: the screw
 * motion (rotation about and translation along one axis) that takes `from` to `to`, stopped at
 * `fraction`. For two cameras of a turntable rig that is exactly the camera on the same circle.
 * K is interpolated linearly, the size is `from`'s. Photographs turned in their own plane by
 * multiples of 90 degrees against each other (the Middlebury gantry does that) are seen through:
 * the quarter turn of `to` that gives the smallest motion is the one used.
 */
Camera InterpolateOnOrbit(const Camera& from, const Camera& to, double fraction);

/** A camera at `centre` looking at `target`, with `up` pointing up in the picture. */
Camera LookAt(const Eigen::Vector3d& centre, const Eigen::Vector3d& target,
  const Eigen::Vector3d& up, const Eigen::Matrix3d& K, int width, int height);

/** The same camera with its pixels joined or divided: K for a picture of another size. */
Camera Resized(const Camera& camera, int width, int height);

/** The largest element of |R R^T - I|: 0 of a rotation or reflection. */
double RotationError(const Eigen::Matrix3d& R);

/** The rotation nearest to a matrix: one that is a rotation to a few digits, or a sum of rotations. */
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& matrix);

/** The point nearest to all optical axes in the least-squares sense: what a rig looks at. */
Eigen::Vector3d CommonTarget(const Camera* cameras, std::size_t count);
}

#endif
