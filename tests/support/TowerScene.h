// SPDX-License-Identifier: GPL-3.0-or-later
/** Photographs of a ball with a tower, which one frame cuts. */
#ifndef novelview_tests_TowerScene_h
#define novelview_tests_TowerScene_h

#include "support/Scene.h"

#include <vector>

namespace support
{
/** y of the tower's upper end. */
inline constexpr double TowerTop = 0.5;

/**
 * The first frame ends in the ball, left of the tower: the object leaves it to the right, and rises
 * there above the frame's part of the object.
 */
inline std::vector<Photo> TowerPhotos()
{
  const Shape object =
    Union({ Sphere(Vector3d::Zero(), 0.3), Box({ 0.1, 0, -0.1 }, { 0.25, TowerTop, 0.1 }) });
  std::vector<novelview::Camera> cameras = Ring(8, 45);
  cameras[0].Width = 85;
  // Five pixels above the ball, and below the tower's upper end.
  cameras[0].K(1, 2) -= 25;
  cameras[0].Height -= 25;
  return TakeAll(object, Plain(200, 200, 200), cameras);
}
}

#endif
