// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs with their true depth maps, whose cameras are then said to be elsewhere.
#ifndef support_CalibrationScene_h
#define support_CalibrationScene_h

#include "support/Scene.h"

#include <random>
#include <vector>

namespace support
{
/** Views with depth maps that are trusted everywhere. */
class CalibrationScene
{
public:
  explicit CalibrationScene(const Texture& texture)
    : Photos(TakeAll(Sphere(Vector3d::Zero(), 0.5), texture, Cameras()))
    , Confidence(Photos[0].Cam.Width, Photos[0].Cam.Height, 1, 1.f)
  {
    for (const Photo& photo : this->Photos)
    {
      this->True.push_back(photo.Cam);
    }
  }

  /** Turns every camera about its centre, by about so many pixels around each axis. */
  void Disturb(double pixels)
  {
    std::mt19937 random(5);
    std::normal_distribution<double> gaussian(0, pixels);
    for (Photo& photo : this->Photos)
    {
      Vector3d turn;
      for (int axis = 0; axis < 3; ++axis)
      {
        turn[axis] = gaussian(random) / photo.Cam.FocalLength();
      }
      const Eigen::Matrix3d r =
        Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
      photo.Cam.R = r * photo.Cam.R;
      photo.Cam.T = r * photo.Cam.T;
    }
  }

  std::vector<novelview::View> Views() const
  {
    std::vector<novelview::View> views = ViewsOf(this->Photos);
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      views[i].DepthMap = this->Photos[i].TrueDepth.Ref();
      views[i].Confidence = this->Confidence.Ref();
    }
    return views;
  }

  std::vector<Photo> Photos;
  std::vector<novelview::Camera> True;

private:
  /** 800 pixels of focal length: the sphere has a radius of 100 pixels. */
  static std::vector<novelview::Camera> Cameras()
  {
    std::vector<novelview::Camera> cameras;
    for (int i = 0; i < 12; ++i)
    {
      Eigen::Matrix3d k;
      k << 800, 0, 159.5, 0, 800, 119.5, 0, 0, 1;
      cameras.push_back(OnRing(30 * i, 0, 4, k, 320, 240));
    }
    return cameras;
  }

  novelview::Image<float> Confidence;
};
}

#endif
