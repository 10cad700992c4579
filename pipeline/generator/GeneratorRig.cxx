// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/GeneratorRig.h"

#include "core/Error.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
double Radians(double degrees)
{
  return degrees * EIGEN_PI / 180;
}

Eigen::Matrix3d CameraMatrix(const GeneratorOptions& options)
{
  const double focal = options.Height / 2.0 / std::tan(Radians(options.FieldOfViewDeg) / 2);
  Eigen::Matrix3d k;
  k << focal, 0, (options.Width - 1) / 2.0, 0, focal, (options.Height - 1) / 2.0, 0, 0, 1;
  return k;
}

/** From the object's centre to the camera at an angle: 0 is on +z, 90 on +x. */
Eigen::Vector3d Outwards(double angleDeg, double elevationDeg)
{
  const double angle = Radians(angleDeg);
  const double elevation = Radians(elevationDeg);
  return { std::sin(angle) * std::cos(elevation), std::sin(elevation),
    std::cos(angle) * std::cos(elevation) };
}

/**
 * The least distance from which a camera looking along -outwards sees all points within `Fill` of
 * its frame: f |x| / (d + z) <= Fill * half a frame for each point, x across and z along the axis.
 */
double DistanceToFit(const std::vector<Eigen::Vector3d>& pointsFromCentre,
  const Eigen::Vector3d& outwards, const GeneratorOptions& options)
{
  const Camera camera = LookAt(outwards, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY(),
    CameraMatrix(options), options.Width, options.Height);
  const double scaleX = camera.K(0, 0) / (options.Fill * options.Width / 2);
  const double scaleY = camera.K(1, 1) / (options.Fill * options.Height / 2);
  double distance = 0;
  for (const Eigen::Vector3d& point : pointsFromCentre)
  {
    const Eigen::Vector3d p = camera.R * point;
    distance =
      std::max(distance, std::max(scaleX * std::abs(p.x()), scaleY * std::abs(p.y())) - p.z());
  }
  return distance;
}

/** The camera turned about its own centre by a rotation given in its frame. */
Camera Turned(const Camera& camera, const Eigen::AngleAxisd& turn)
{
  Camera turned = camera;
  turned.R = turn.toRotationMatrix() * camera.R;
  turned.T = -(turned.R * camera.Centre());
  return turned;
}

/** Aims every chosen camera past the object, left and right in turns. */
void ShiftFrames(std::vector<Camera>& cameras, const GeneratorOptions& options)
{
  std::vector<int> shifted = options.FrameShiftViews;
  if (shifted.empty() && options.FrameShift != 0)
  {
    for (int viewId = 0; viewId < options.Views; viewId += 3)
    {
      shifted.push_back(viewId);
    }
  }
  double side = 1;
  for (const int viewId : shifted)
  {
    Camera& camera = cameras[viewId];
    const double angle = std::atan(side * options.FrameShift * options.Width / camera.K(0, 0));
    camera = Turned(camera, Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()));
    side = -side;
  }
}

/** How high a photograph's camera is; held-out views are on the first ring. */
double ElevationDegOf(std::size_t camera, const GeneratorOptions& options)
{
  const bool second = camera < static_cast<std::size_t>(options.Views) && camera % 2 == 1;
  return options.ElevationDeg + (second ? options.SecondRingDeg : 0);
}

void DisturbCalibration(std::vector<Camera>& cameras, const GeneratorOptions& options)
{
  cv::RNG random(0x9E3779B97F4A7C15ull ^ static_cast<std::uint64_t>(options.Seed));
  cv::RNG lens(0xD1B54A32D192ED03ull ^ static_cast<std::uint64_t>(options.Seed));
  for (Camera& camera : cameras)
  {
    Eigen::Vector3d turn;
    for (int axis = 0; axis < 3; ++axis)
    {
      turn[axis] = random.gaussian(options.CalibrationNoisePx / camera.FocalLength());
    }
    if (turn.norm() > 0)
    {
      camera = Turned(camera, Eigen::AngleAxisd(turn.norm(), turn.normalized()));
    }
    const double focal = 1 + lens.gaussian(options.FocalNoise);
    camera.K(0, 0) *= focal;
    camera.K(1, 1) *= focal;
    camera.K(0, 2) += lens.gaussian(options.PrincipalNoisePx);
    camera.K(1, 2) += lens.gaussian(options.PrincipalNoisePx);
  }
}
}

//------------------------------------------------------------------------------
Rig MakeRig(vtkPolyData* mesh, const GeneratorOptions& options)
{
  double bounds[6];
  mesh->GetBounds(bounds);
  const Eigen::Vector3d centre(
    (bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2, (bounds[4] + bounds[5]) / 2);
  std::vector<Eigen::Vector3d> points;
  points.reserve(mesh->GetNumberOfPoints());
  for (vtkIdType ptId = 0; ptId < mesh->GetNumberOfPoints(); ++ptId)
  {
    points.push_back(Eigen::Vector3d(mesh->GetPoint(ptId)) - centre);
  }

  std::vector<double> anglesDeg;
  for (int viewId = 0; viewId < options.Views; ++viewId)
  {
    anglesDeg.push_back(viewId * options.StepDeg);
  }
  anglesDeg.insert(anglesDeg.end(), options.TestAnglesDeg.begin(), options.TestAnglesDeg.end());
  double distance = 0;
  for (std::size_t i = 0; i < anglesDeg.size(); ++i)
  {
    distance = std::max(
      distance, DistanceToFit(points, Outwards(anglesDeg[i], ElevationDegOf(i, options)), options));
  }

  Rig rig;
  for (std::size_t i = 0; i < anglesDeg.size(); ++i)
  {
    const Eigen::Vector3d outwards = Outwards(anglesDeg[i], ElevationDegOf(i, options));
    const Camera camera = LookAt(centre + distance * outwards, centre, Eigen::Vector3d::UnitY(),
      CameraMatrix(options), options.Width, options.Height);
    (i < static_cast<std::size_t>(options.Views) ? rig.Views : rig.Tests).push_back(camera);
  }
  ShiftFrames(rig.Views, options);
  rig.Written = rig.Views;
  DisturbCalibration(rig.Written, options);
  return rig;
}
}
