// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/Camera.h"

#include "core/Error.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace novelview
{
namespace
{
std::string RowText(const Eigen::Matrix3d& m)
{
  std::ostringstream text;
  text << m.format(Eigen::IOFormat(6, Eigen::DontAlignCols, " ", "; "));
  return text.str();
}

/** Parts of an image's larger side that calibrations stay between. */
constexpr double MinFocal = 1e-3;
constexpr double MaxFocal = 1e4;        // almost parallel rays
constexpr double MaxOffset = 1e3;       // of the principal point: a small part of a large image
constexpr double MaxSize = 1 << 20;     ///< pixels
constexpr double MaxTranslation = 1e12; ///< world units

/** The larger side of an image, pixels, from what it is at least to what it is at most. */
struct SizeRange
{
  double Min;
  double Max;
};

void CheckRange(const char* what, double value, double least, double most, const std::string& where)
{
  if (!(value >= least && value <= most))
  {
    std::ostringstream got;
    std::ostringstream range;
    got << value;
    range << least << " to " << most;
    throw Error(where, std::string(what) + " is out of range", got.str(), range.str());
  }
}

/** Whether the numbers of a camera are plausible for images of this size. */
void CheckRanges(const Camera& camera, const SizeRange& size, const std::string& where)
{
  const Eigen::Matrix3d& K = camera.K;
  CheckRange("focal length fx", K(0, 0), MinFocal * size.Min, MaxFocal * size.Max, where);
  CheckRange("focal length fy", K(1, 1), MinFocal * size.Min, MaxFocal * size.Max, where);
  CheckRange("skew", K(0, 1), -MaxFocal * size.Max, MaxFocal * size.Max, where);
  CheckRange("principal point cx", K(0, 2), -MaxOffset * size.Max, MaxOffset * size.Max, where);
  CheckRange("principal point cy", K(1, 2), -MaxOffset * size.Max, MaxOffset * size.Max, where);
  CheckRange("translation", camera.T.cwiseAbs().maxCoeff(), 0, MaxTranslation, where);
}

/** Whether all numbers are some, and K is one of a pinhole. */
void CheckForm(const Camera& camera, const std::string& where)
{
  if (!camera.K.allFinite() || !camera.R.allFinite() || !camera.T.allFinite())
  {
    throw Error(where, "calibration has numbers that are not finite");
  }
  const double scale = camera.K.cwiseAbs().maxCoeff();
  const bool triangular = std::abs(camera.K(1, 0)) <= 1e-9 * scale &&
    std::abs(camera.K(2, 0)) <= 1e-9 && std::abs(camera.K(2, 1)) <= 1e-9 &&
    std::abs(camera.K(2, 2) - 1) <= 1e-9;
  if (!triangular || camera.K(0, 0) <= 0 || camera.K(1, 1) <= 0)
  {
    throw Error(where, "camera matrix K is singular or not a pinhole's", RowText(camera.K),
      "fx s cx; 0 fy cy; 0 0 1 with fx, fy > 0");
  }
}

/** Everything but the size itself. */
void Validate(const Camera& camera, const SizeRange& size, const std::string& where)
{
  CheckForm(camera, where);
  CheckRanges(camera, size, where);
  const double offOrthogonal = RotationError(camera.R);
  if (!(offOrthogonal <= 1e-3) || camera.R.determinant() < 0)
  {
    throw Error(
      where, "R is not a rotation", RowText(camera.R), "orthonormal rows and determinant +1");
  }
}

/** A world-to-world rigid motion x -> Q x + D. */
struct Motion
{
  Eigen::Matrix3d Q;
  Eigen::Vector3d D;
};

/** The motion that takes camera `from`'s frame to that of `to`, both as camera-to-world frames. */
Motion MotionBetween(const Camera& from, const Eigen::Matrix3d& rotationTo, const Camera& to)
{
  Motion motion;
  motion.Q = rotationTo.transpose() * from.R;
  motion.D = to.Centre() - motion.Q * from.Centre();
  return motion;
}

/** The screw with the same axis and pitch, a fraction of the way. */
Motion FractionOfMotion(const Motion& motion, double fraction)
{
  const Eigen::AngleAxisd turn(motion.Q);
  Motion part;
  part.Q = Eigen::AngleAxisd(fraction * turn.angle(), turn.axis()).toRotationMatrix();
  const double halfTangent = std::tan(turn.angle() / 2);
  if (std::abs(halfTangent) < 1e-9)
  {
    part.D = fraction * motion.D;
    return part;
  }
  const Eigen::Vector3d& axis = turn.axis();
  const Eigen::Vector3d along = axis.dot(motion.D) * axis;
  const Eigen::Vector3d across = motion.D - along;
  const Eigen::Vector3d pointOnAxis = 0.5 * (across + axis.cross(across) / halfTangent);
  part.D = pointOnAxis - part.Q * pointOnAxis + fraction * along;
  return part;
}
}

Eigen::Vector3d Camera::Unproject(const Eigen::Vector2d& pixel, double depth) const
{
  // K is upper triangular with K(2,2) = 1, so the back substitution is exact and cheap.
  const double y = (pixel.y() - this->K(1, 2)) / this->K(1, 1);
  const double x = (pixel.x() - this->K(0, 2) - this->K(0, 1) * y) / this->K(0, 0);
  return this->R.transpose() * (Eigen::Vector3d(x, y, 1) * depth - this->T);
}

Eigen::Vector3d Camera::RayDirection(const Eigen::Vector2d& pixel) const
{
  return (this->Unproject(pixel, 1.0) - this->Centre()).normalized();
}

void ValidateCalibration(const Camera& camera, const std::string& where)
{
  Validate(camera, { 1, MaxSize }, where);
}

void ValidateCamera(const Camera& camera, const std::string& where)
{
  if (camera.Width <= 0 || camera.Height <= 0)
  {
    throw Error(
      where, "image size is not positive", SizeText(camera.Width, camera.Height), "at least 1x1");
  }
  const double size = std::max(camera.Width, camera.Height);
  Validate(camera, { size, size }, where);
}

Camera InterpolateOnOrbit(const Camera& from, const Camera& to, double fraction)
{
  Motion best;
  double bestAngle = 2 * EIGEN_PI;
  for (int quarter = 0; quarter < 4; ++quarter)
  {
    const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(quarter * EIGEN_PI / 2, Eigen::Vector3d::UnitZ()) * to.R;
    const Motion motion = MotionBetween(from, rotation, to);
    const double angle = Eigen::AngleAxisd(motion.Q).angle();
    if (angle < bestAngle - 1e-9)
    {
      bestAngle = angle;
      best = motion;
    }
  }
  const Motion part = FractionOfMotion(best, fraction);
  Camera camera = from;
  camera.K = (1 - fraction) * from.K + fraction * to.K;
  camera.R = from.R * part.Q.transpose();
  camera.T = -(camera.R * (part.Q * from.Centre() + part.D));
  return camera;
}

Camera LookAt(const Eigen::Vector3d& centre, const Eigen::Vector3d& target,
  const Eigen::Vector3d& up, const Eigen::Matrix3d& K, int width, int height)
{
  const Eigen::Vector3d forward = (target - centre).normalized();
  const Eigen::Vector3d right = forward.cross(up).normalized();
  Camera camera;
  camera.K = K;
  camera.R.row(0) = right;
  camera.R.row(1) = forward.cross(right);
  camera.R.row(2) = forward;
  camera.T = -(camera.R * centre);
  camera.Width = width;
  camera.Height = height;
  return camera;
}

Camera Resized(const Camera& camera, int width, int height)
{
  const double x = static_cast<double>(width) / camera.Width;
  const double y = static_cast<double>(height) / camera.Height;
  Camera result = camera;
  // Pixel centres are integers: x + 0.5 is what scales.
  result.K.topRows<2>() = Eigen::Vector2d(x, y).asDiagonal() * camera.K.topRows<2>();
  result.K(0, 2) += (x - 1) / 2;
  result.K(1, 2) += (y - 1) / 2;
  result.Width = width;
  result.Height = height;
  return result;
}

double RotationError(const Eigen::Matrix3d& R)
{
  return (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& matrix)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d& u = svd.matrixU();
  const Eigen::Matrix3d& v = svd.matrixV();
  return u * Eigen::Vector3d(1, 1, (u * v.transpose()).determinant()).asDiagonal() * v.transpose();
}

Eigen::Vector3d CommonTarget(const Camera* cameras, std::size_t count)
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < count; ++i)
  {
    const Eigen::Vector3d axis = cameras[i].OpticalAxis();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
    sum += across;
    moment += across * cameras[i].Centre();
  }
  // Parallel axes leave a line of equally good points; the pseudo-inverse takes the one nearest
  // to the world's origin.
  return sum.completeOrthogonalDecomposition().solve(moment);
}
}
