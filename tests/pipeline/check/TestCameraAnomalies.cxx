// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/CameraAnomalies.h"
#include "support/Scene.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace novelview;

namespace
{
std::vector<Photograph> SixCameras()
{
  std::vector<Photograph> cameras(6);
  for (int i = 0; i < 6; ++i)
  {
    cameras[i].Name = std::to_string(i);
    cameras[i].Cam = support::OnRing(60.0 * i, 10);
  }
  return cameras;
}

void ExpectAnomaly(const std::vector<Photograph>& cameras, int id, const std::string& kind)
{
  const std::vector<CameraAnomaly> anomalies = FindCameraAnomalies(cameras);
  ASSERT_EQ(anomalies.size(), 1u) << kind;
  EXPECT_EQ(anomalies[0].Kind, kind);
  EXPECT_EQ(anomalies[0].CameraId, id);
}
}

TEST(CameraAnomalies, OddCamerasAreNamed)
{
  EXPECT_TRUE(FindCameraAnomalies(SixCameras()).empty());
  std::vector<Photograph> cameras = SixCameras();
  cameras[1].Cam.K(0, 2) = 200; // of 160
  ExpectAnomaly(cameras, 1, "principal-point");
  cameras = SixCameras();
  cameras[2].Cam.K.topLeftCorner<2, 2>() /= 20; // 20 px, an eighth of the frame
  ExpectAnomaly(cameras, 2, "focal-length");
  cameras = SixCameras();
  cameras[3].Cam.K(1, 1) *= 1.5;
  ExpectAnomaly(cameras, 3, "aspect");
  cameras = SixCameras();
  cameras[4].Cam.R(0, 0) += 1e-4;
  ExpectAnomaly(cameras, 4, "rotation");
  cameras = SixCameras();
  cameras[5].Cam = cameras[0].Cam;
  ExpectAnomaly(cameras, 5, "same-camera");
  cameras = SixCameras();
  // Looks out of the ring instead of in.
  cameras[0].Cam = LookAt(cameras[0].Cam.Centre(), 2 * cameras[0].Cam.Centre(),
    Eigen::Vector3d::UnitY(), cameras[0].Cam.K, 160, 120);
  ExpectAnomaly(cameras, 0, "frustum");
}
