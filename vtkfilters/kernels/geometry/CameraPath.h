// SPDX-License-Identifier: GPL-3.0-or-later
/** The path of a moving camera: around a ring of cameras, or through key cameras. */
#ifndef novelview_CameraPath_h
#define novelview_CameraPath_h

#include "geometry/Camera.h"

#include <vector>

namespace novelview
{
/**
 * The circle that the cameras of a turntable stand on, and how they stand there. A camera at the
 * angle a has its centre at Centre + Radius e_r(a), e_r = cos(a) Across + sin(a) (Axis x Across),
 * and the rotation R = InRing [e_r, Axis x e_r, Axis]'.
 */
struct CameraRing
{
  Eigen::Vector3d Centre; ///< of the circle: on the axis, at the cameras' mean height
  Eigen::Vector3d Axis;   ///< unit; up in the images, if defined
  Eigen::Vector3d Across; ///< unit, orthogonal to the axis: towards the first camera, angle 0
  double Radius = 0;      ///< world units
  double Sense = 1;       ///< 1 when the second camera is on the side of growing angles, else -1
  Eigen::Matrix3d InRing; ///< mean rotation of the cameras in the ring's own frame
  Eigen::Matrix3d K;      ///< mean
  int Width = 0;
  int Height = 0;

  /** The camera after `turn` of the whole circle, 0 to 1; 0 is where the first camera stands. */
  Camera At(double turn) const;
};

/**
 * Fits the circle to the cameras' centres (the plane of least squares, in it the circle of least
 * squares) and averages how they stand. Photographs turned in their own plane by multiples of 90
 * degrees are seen through, as in InterpolateOnOrbit(). A camera may be a tenth of the radius off
 * the circle and 30 degrees off the mean direction, and no third of the circle may be without one:
 * else, and with less than three cameras, throws Error "cameras: are on no ring ..".
 */
CameraRing FitCameraRing(const std::vector<Camera>& cameras);

/** A camera that is passed at a time; times in any unit. */
struct KeyCamera
{
  double Time = 0;
  Camera Cam;
};

/**
 * A smooth path through key cameras. Centres go along a cubic Hermite spline whose velocity is
 * continuous (at a key that of the parabola through it and its neighbours; natural ends), rotations
 * turn evenly from key to key the short way (slerp), K is interpolated linearly; the size is that
 * of the first key. A closed path continues from the last key to the first in the mean time between
 * two keys.
 */
class CameraPath
{
public:
  /** Throws Error unless there are two keys and times grow. */
  explicit CameraPath(std::vector<KeyCamera> keys, bool closed = false);

  double Begin() const { return this->Keys.front().Time; }
  /** The last key's time or, when closed, that of the return to the first. */
  double End() const { return this->Keys.back().Time; }

  /** Times before the first or after the last are those. A key's time gives the key itself. */
  Camera At(double time) const;

private:
  std::vector<KeyCamera> Keys; ///< when closed, the first again at the end
  std::vector<Eigen::Vector3d> Velocities;
};
}

#endif
