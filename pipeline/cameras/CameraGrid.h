// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CameraGrid_h
#define novelview_CameraGrid_h

#include "cameras/Photograph.h"
#include "geometry/Camera.h"

#include <Eigen/Core>

#include <vector>

namespace novelview
{
/**
 * Rounds cameras far below what shows in an image. The formats of calibrations lose the last bits
 * of cameras in different ways (quaternions, inverse poses, projection matrices); on the grid all of
 * them give the same camera, and so the same bits of every result.
 *
 * R becomes the nearest rotation, in steps of 2^-26; the place of what all cameras look at, in the
 * camera's frame, has steps of 2^-26 of its distance, so that objects far from the world's origin
 * stay where they are in the photographs; K has steps of 2^-20 pixels.
 */
class CameraGrid
{
public:
  /** @param photographs of the rig; none = about the world's origin. */
  explicit CameraGrid(const std::vector<Photograph>& photographs);

  Camera Rounded(const Camera& camera) const;

  /** With the nearest rotation only; what the cameras look at stays where it is in the image. */
  Camera WithRotation(const Camera& camera) const;

private:
  Eigen::Vector3d Target; ///< what the cameras look at, roughly
};
}

#endif
