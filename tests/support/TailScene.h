// SPDX-License-Identifier: GPL-3.0-or-later
// A ball with a small one on top, which some masks lack.
#ifndef support_TailScene_h
#define support_TailScene_h

#include "support/SphereScene.h"

#include <vector>

namespace support
{
inline const Vector3d TailCentre(0, -0.5, 0);
inline constexpr double TailRadius = 0.12;

/** Whether a pixel shows the small ball and nothing of the large one. */
inline bool ShowsTail(const Photo& photo, int x, int y)
{
  const Vector3d centre = photo.Cam.Centre();
  const Vector3d ray = photo.Cam.RayDirection(Vector2d(x, y));
  return Sphere(TailCentre, TailRadius)(centre, ray) && !Sphere(Vector3d::Zero(), 0.4)(centre, ray);
}

/** Twelve photographs; in those of `lacking` the tail is black, and not in the mask. */
inline std::vector<Photo> PhotosOfTail(const std::vector<int>& lacking)
{
  std::vector<Photo> photos =
    TakeAll(Union({ Sphere(Vector3d::Zero(), 0.4), Sphere(TailCentre, TailRadius) }),
      Plain(200, 180, 160), Ring(12, 30, Focal));
  for (const int viewId : lacking)
  {
    Photo& photo = photos[viewId];
    novelview::Image<std::uint8_t> mask = photo.Mask;
    for (int y = 0; y < mask.Height; ++y)
    {
      for (int x = 0; x < mask.Width; ++x)
      {
        if (ShowsTail(photo, x, y))
        {
          mask(x, y) = 0;
          std::fill_n(&photo.Color(x, y, 0), 3, std::uint8_t(0));
        }
      }
    }
    SetMask(photo, std::move(mask));
  }
  return photos;
}
}

#endif
