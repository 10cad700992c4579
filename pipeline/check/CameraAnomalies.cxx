// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/CameraAnomalies.h"

#include "base/NumberText.h"
#include "core/Error.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
std::string Rounded(double value)
{
  return Formatted("%.4g", value);
}

/** The parts of one camera that speak for themselves. */
void InspectCamera(const Camera& camera, int id, std::vector<CameraAnomaly>& anomalies)
{
  const auto add = [&](const char* kind, const std::string& text) {
    anomalies.push_back({ kind, id, text, -1 });
  };
  const double longer = std::max(camera.Width, camera.Height);
  const Eigen::Vector2d principal = camera.K.block<2, 1>(0, 2);
  if (!camera.InFrame(principal))
  {
    add("principal-point",
      "principal point (" + Rounded(principal.x()) + ", " + Rounded(principal.y()) +
        ") lies outside of the frame of " + SizeText(camera.Width, camera.Height));
  }
  const double focal = camera.FocalLength();
  if (focal < 0.2 * longer || focal > 30 * longer)
  {
    add("focal-length",
      "focal length of " + Rounded(focal) + " px is " + Rounded(focal / longer) +
        " times the longer side; is K for another size, or in other units?");
  }
  const double aspect = camera.K(1, 1) / camera.K(0, 0);
  if (aspect > 1.25 || aspect < 0.8)
  {
    add("aspect", "fy / fx is " + Rounded(aspect) + "; pixels are nearly square in most cameras");
  }
  const double off = RotationError(camera.R);
  if (off > 1e-5)
  {
    add("rotation", "rotation is orthonormal to " + Rounded(off) + " only: too few digits");
  }
}

/** The largest distance of two centres. */
double RigExtent(const std::vector<Photograph>& cameras)
{
  double extent = 0;
  for (const Photograph& a : cameras)
  {
    extent = std::max(extent, (a.Cam.Centre() - cameras.front().Cam.Centre()).norm());
  }
  return extent;
}

void FindSameCameras(const std::vector<Photograph>& cameras, std::vector<CameraAnomaly>& anomalies)
{
  constexpr double Nearly = 1e-6; // of the rig; as radians less than any calibration knows
  const double extent = RigExtent(cameras);
  for (std::size_t i = 1; i < cameras.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const Camera& a = cameras[i].Cam;
      const Camera& b = cameras[j].Cam;
      if ((a.Centre() - b.Centre()).norm() <= Nearly * extent && (a.R - b.R).norm() <= Nearly)
      {
        anomalies.push_back({ "same-camera", static_cast<int>(i),
          "its camera is that of " + cameras[j].Name +
            ": the same photograph again, or a wrong pose",
          static_cast<int>(j) });
        break;
      }
    }
  }
}

/** The largest part of the other cameras that have one point of the camera's axis in the frame. */
double SharedViewFraction(const std::vector<Photograph>& cameras, std::size_t id, double scale)
{
  constexpr int Steps = 256;
  const Camera& camera = cameras[id].Cam;
  const Eigen::Vector3d axis =
    camera.RayDirection({ (camera.Width - 1) / 2.0, (camera.Height - 1) / 2.0 });
  int most = 0;
  for (int i = 1; i < Steps; ++i)
  {
    // Half of the points lie within the rig's extent, the last ones far out.
    const double q = static_cast<double>(i) / Steps;
    const Eigen::Vector3d point = camera.Centre() + scale * q / (1 - q) * axis;
    int seen = 0;
    for (std::size_t other = 0; other < cameras.size(); ++other)
    {
      const Camera& cam = cameras[other].Cam;
      seen += other != id && cam.Depth(point) > 0 && cam.InFrame(cam.Project(point));
    }
    most = std::max(most, seen);
  }
  return most / static_cast<double>(cameras.size() - 1);
}
}

std::vector<CameraAnomaly> FindCameraAnomalies(const std::vector<Photograph>& cameras)
{
  std::vector<CameraAnomaly> anomalies;
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    InspectCamera(cameras[i].Cam, static_cast<int>(i), anomalies);
  }
  FindSameCameras(cameras, anomalies);
  const double extent = RigExtent(cameras);
  for (std::size_t i = 0; i < cameras.size() && extent > 0; ++i)
  {
    const double share = SharedViewFraction(cameras, i, extent);
    if (share < 0.5)
    {
      anomalies.push_back({ "frustum", static_cast<int>(i),
        "no point of its axis lies in the frames of more than " +
          std::to_string(static_cast<int>(std::lround(100 * share))) +
          " % of the other cameras: its pose is wrong, or it faces away from the object",
        -1 });
    }
  }
  return anomalies;
}
}
