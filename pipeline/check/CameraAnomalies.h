// SPDX-License-Identifier: GPL-3.0-or-later
/** Whether cameras can be those of photographs of one object. */
#ifndef novelview_CameraAnomalies_h
#define novelview_CameraAnomalies_h

#include "cameras/Photograph.h"

#include <string>
#include <vector>

namespace novelview
{
/** Something odd about a camera. */
struct CameraAnomaly
{
  std::string Kind; ///< "principal-point", "focal-length", "aspect", "rotation", "same-camera",
                    ///< "frustum"
  int CameraId = 0;
  std::string Text;
  int OtherId = -1; ///< the other one of "same-camera"
};

/**
 * Looks at cameras with known sizes:
 *
 *  - principal-point: it lies outside of the frame
 *  - focal-length: less than a fifth or more than thirty times the longer side
 *  - aspect: pixels more than a quarter longer than wide, or the other way round
 *  - rotation: not orthonormal to 1e-5, which is less than a calibration with six digits has
 *  - same-camera: another one stands at the same place and looks the same way
 *  - frustum: no point on its axis lies in the frames of half of the others
 */
std::vector<CameraAnomaly> FindCameraAnomalies(const std::vector<Photograph>& cameras);
}

#endif
