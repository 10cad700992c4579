// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_FrameRequest_h
#define novelview_FrameRequest_h

#include "geometry/Camera.h"

#include <string>

namespace novelview
{
/** A picture that the page wants. */
struct FrameRequest
{
  static constexpr int LargestSidePx = 4096;

  Camera Cam;
  std::string UpTo = "full"; ///< hull, outline or full
};

/**
 * From {"K": 9 numbers, "R": 9, "T": 3, "width": px, "height": px, "stage": word}, matrices row by
 * row. Throws Error when anything is missing, of another type, or no valid camera.
 */
FrameRequest ParseFrameRequest(const std::string& json);
}

#endif
