// SPDX-License-Identifier: GPL-3.0-or-later
/** Photographs of a sphere about the origin. */
#ifndef novelview_tests_SphereScene_h
#define novelview_tests_SphereScene_h

#include "silhouettes/ContourDistance.h"
#include "support/Scene.h"

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace support
{
inline constexpr double Radius = 0.5;

/** Leaves room around the object: what no frame shows may be anything, and is not the subject. */
inline constexpr double Focal = 300;

inline novelview::Camera RoomyCamera(double angleDeg, double elevationDeg = 0)
{
  return OnRing(angleDeg, elevationDeg, 4, SmallPictureK(Focal));
}

/** A ring of eight and one camera from above, so that the hull is close to the sphere. */
inline std::vector<novelview::Camera> NineCameras()
{
  std::vector<novelview::Camera> cameras = Ring(8, 45, Focal);
  cameras.push_back(RoomyCamera(20, 70));
  return cameras;
}

inline const std::vector<Photo>& SpherePhotos()
{
  static const std::vector<Photo> photos =
    TakeAll(Sphere(Vector3d::Zero(), Radius), Plain(200, 200, 200), NineCameras());
  return photos;
}

inline std::vector<Vector3d> RandomPoints(int count, double halfSide, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-halfSide, halfSide);
  std::vector<Vector3d> points(count);
  for (Vector3d& point : points)
  {
    point = { uniform(random), uniform(random), uniform(random) };
  }
  return points;
}

/** Replaces a mask and what is derived from it. */
inline void SetMask(Photo& photo, novelview::Image<std::uint8_t> mask)
{
  photo.Mask = std::move(mask);
  photo.ContourDistance = novelview::SignedContourDistance(std::as_const(photo.Mask).Ref());
}
}

#endif
