// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/CameraPath.h"

#include "core/Error.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace novelview
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double MaxOff = 0.1;        ///< of a camera from the circle, radii
constexpr double MaxTiltDeg = 30;     ///< of a camera from the mean direction
constexpr double LargestGapDeg = 121; ///< between neighbours: three evenly spread are just enough

[[noreturn]] void RefuseRing(
  const std::string& what, double got, const char* unit, const std::string& expected)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%.3g%s", got, unit);
  throw Error("cameras", "are on no ring: " + what, text, expected);
}

/** Circle through points of a plane in the least-squares sense (Kasa): centre x, y and radius. */
Vector3d FitCircle(const Eigen::MatrixX2d& points)
{
  Eigen::MatrixX3d a(points.rows(), 3);
  a.leftCols<2>() = 2 * points;
  a.col(2).setOnes();
  const Vector3d solved = a.colPivHouseholderQr().solve(points.rowwise().squaredNorm());
  return { solved.x(), solved.y(),
    std::sqrt(std::max(solved.z() + solved.head<2>().squaredNorm(), 0.0)) };
}

Matrix3d RingFrame(const Vector3d& outwards, const Vector3d& axis)
{
  Matrix3d frame;
  frame << outwards, axis.cross(outwards), axis;
  return frame;
}

double AngleBetween(const Matrix3d& a, const Matrix3d& b)
{
  return Eigen::AngleAxisd(a * b.transpose()).angle();
}

/** Turned in the image's plane by the quarter turns that bring it nearest to another. */
Matrix3d QuarterTurnedTo(const Matrix3d& rotation, const Matrix3d& other)
{
  Matrix3d best = rotation;
  for (int quarter = 1; quarter < 4; ++quarter)
  {
    const Matrix3d turned = Eigen::AngleAxisd(quarter * EIGEN_PI / 2, Vector3d::UnitZ()) * rotation;
    if (AngleBetween(turned, other) < AngleBetween(best, other) - 1e-9)
    {
      best = turned;
    }
  }
  return best;
}

/** Sets Centre, Axis and Radius. */
void FitCentres(const std::vector<Camera>& cameras, CameraRing& ring)
{
  Eigen::MatrixX3d centres(static_cast<Eigen::Index>(cameras.size()), 3);
  Vector3d up = Vector3d::Zero();
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    centres.row(static_cast<Eigen::Index>(i)) = cameras[i].Centre();
    up -= cameras[i].R.row(1);
  }
  const Vector3d mean = centres.colwise().mean();
  const Eigen::MatrixX3d apart = centres.rowwise() - mean.transpose();
  const Eigen::JacobiSVD<Eigen::MatrixX3d> svd(apart, Eigen::ComputeFullV);
  const Matrix3d& basis = svd.matrixV();
  if (!(svd.singularValues()[1] > 1e-3 * svd.singularValues()[0]))
  {
    throw Error("cameras", "are on no ring: they stand on a line or at one place");
  }
  const Vector3d circle = FitCircle(apart * basis.leftCols<2>());
  ring.Centre = mean + basis.leftCols<2>() * circle.head<2>();
  ring.Axis = basis.col(2) * (up.dot(basis.col(2)) < 0 ? -1 : 1);
  ring.Radius = circle.z();
  for (const Camera& camera : cameras)
  {
    const Vector3d from = camera.Centre() - ring.Centre;
    const double height = from.dot(ring.Axis);
    const double across = (from - height * ring.Axis).norm() - ring.Radius;
    if (const double off = std::hypot(height, across) / ring.Radius; !(off <= MaxOff))
    {
      RefuseRing("one is far off the others' circle", off, " radii", "at most 0.1 radii");
    }
  }
}

/** Sets Across, Sense; returns the angle of every camera. */
std::vector<double> FindAngles(const std::vector<Camera>& cameras, CameraRing& ring)
{
  const auto across = [&ring](const Camera& camera)
  {
    const Vector3d from = camera.Centre() - ring.Centre;
    return Vector3d((from - from.dot(ring.Axis) * ring.Axis).normalized());
  };
  ring.Across = across(cameras.front());
  const Vector3d side = ring.Axis.cross(ring.Across);
  std::vector<double> angles;
  for (const Camera& camera : cameras)
  {
    const Vector3d outwards = across(camera);
    angles.push_back(std::atan2(outwards.dot(side), outwards.dot(ring.Across)));
  }
  ring.Sense = angles[1] < 0 ? -1 : 1;
  std::vector<double> sorted = angles;
  std::sort(sorted.begin(), sorted.end());
  double gap = sorted.front() + 2 * EIGEN_PI - sorted.back();
  for (std::size_t i = 1; i < sorted.size(); ++i)
  {
    gap = std::max(gap, sorted[i] - sorted[i - 1]);
  }
  if (const double gapDeg = gap * 180 / EIGEN_PI; gapDeg > LargestGapDeg)
  {
    RefuseRing("a part of the circle is without one", gapDeg, " deg", "at most 120 deg");
  }
  return angles;
}
}

Camera CameraRing::At(double turn) const
{
  const double angle = 2 * EIGEN_PI * turn * this->Sense;
  const Vector3d outwards =
    (std::cos(angle) * this->Across + std::sin(angle) * this->Axis.cross(this->Across));
  Camera camera;
  camera.K = this->K;
  camera.R = this->InRing * RingFrame(outwards, this->Axis).transpose();
  camera.T = -(camera.R * (this->Centre + this->Radius * outwards));
  camera.Width = this->Width;
  camera.Height = this->Height;
  return camera;
}

CameraRing FitCameraRing(const std::vector<Camera>& cameras)
{
  if (cameras.size() < 3)
  {
    throw Error("cameras", "are on no ring: too few", std::to_string(cameras.size()), "at least 3");
  }
  CameraRing ring;
  FitCentres(cameras, ring);
  const std::vector<double> angles = FindAngles(cameras, ring);
  std::vector<Matrix3d> standing;
  Matrix3d sum = Matrix3d::Zero();
  Matrix3d sumK = Matrix3d::Zero();
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    const Vector3d outwards =
      std::cos(angles[i]) * ring.Across + std::sin(angles[i]) * ring.Axis.cross(ring.Across);
    const Matrix3d own = cameras[i].R * RingFrame(outwards, ring.Axis);
    standing.push_back(standing.empty() ? own : QuarterTurnedTo(own, standing.front()));
    sum += standing.back();
    sumK += cameras[i].K;
  }
  ring.InRing = NearestRotation(sum);
  for (const Matrix3d& each : standing)
  {
    if (const double tiltDeg = AngleBetween(each, ring.InRing) * 180 / EIGEN_PI;
        tiltDeg > MaxTiltDeg)
    {
      RefuseRing("one looks elsewhere than the others", tiltDeg, " deg", "at most 30 deg");
    }
  }
  ring.K = sumK / static_cast<double>(cameras.size());
  ring.Width = cameras.front().Width;
  ring.Height = cameras.front().Height;
  return ring;
}

//------------------------------------------------------------------------------
CameraPath::CameraPath(std::vector<KeyCamera> keys, bool closed)
  : Keys(std::move(keys))
{
  if (this->Keys.size() < 2)
  {
    throw Error("camera path", "too few key cameras", std::to_string(this->Keys.size()), "2");
  }
  for (std::size_t i = 1; i < this->Keys.size(); ++i)
  {
    if (!(this->Keys[i].Time > this->Keys[i - 1].Time))
    {
      throw Error("camera path", "key " + std::to_string(i) + " is not after the one before it");
    }
  }
  const std::size_t count = this->Keys.size();
  if (closed)
  {
    const double mean = (this->End() - this->Begin()) / static_cast<double>(count - 1);
    this->Keys.push_back({ this->End() + mean, this->Keys.front().Cam });
  }
  std::vector<double> times;
  std::vector<Vector3d> slopes;
  for (std::size_t i = 1; i < this->Keys.size(); ++i)
  {
    times.push_back(this->Keys[i].Time - this->Keys[i - 1].Time);
    slopes.push_back((this->Keys[i].Cam.Centre() - this->Keys[i - 1].Cam.Centre()) / times.back());
  }
  const auto between = [&](std::size_t before, std::size_t after) -> Vector3d
  {
    return (slopes[before] * times[after] + slopes[after] * times[before]) /
      (times[before] + times[after]);
  };
  const std::size_t last = slopes.size() - 1;
  this->Velocities.resize(this->Keys.size());
  for (std::size_t i = 1; i <= last; ++i)
  {
    this->Velocities[i] = between(i - 1, i);
  }
  const bool straight = last == 0;
  this->Velocities.front() = closed ? between(last, 0)
    : straight                      ? slopes[0]
                                    : Vector3d((3 * slopes[0] - this->Velocities[1]) / 2);
  this->Velocities.back() = closed ? this->Velocities.front()
    : straight                     ? slopes[0]
                                   : Vector3d((3 * slopes[last] - this->Velocities[last]) / 2);
}

Camera CameraPath::At(double time) const
{
  time = std::clamp(time, this->Begin(), this->End());
  std::size_t i = 0;
  while (i + 2 < this->Keys.size() && time >= this->Keys[i + 1].Time)
  {
    ++i;
  }
  const KeyCamera& from = this->Keys[i];
  const KeyCamera& to = this->Keys[i + 1];
  const double span = to.Time - from.Time;
  const double s = (time - from.Time) / span;
  if (s <= 0 || s >= 1)
  {
    Camera key = s <= 0 ? from.Cam : to.Cam;
    key.Width = this->Keys.front().Cam.Width;
    key.Height = this->Keys.front().Cam.Height;
    return key;
  }
  const double r = 1 - s;
  const Vector3d centre = r * r * (1 + 2 * s) * from.Cam.Centre() +
    s * s * (1 + 2 * r) * to.Cam.Centre() +
    s * r * span * (r * this->Velocities[i] - s * this->Velocities[i + 1]);
  Camera camera = this->Keys.front().Cam;
  camera.K = r * from.Cam.K + s * to.Cam.K;
  camera.R = Eigen::Quaterniond(from.Cam.R).slerp(s, Eigen::Quaterniond(to.Cam.R)).normalized();
  camera.T = -(camera.R * centre);
  return camera;
}
}
