// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_FrameRequest_h
#define novelview_FrameRequest_h

#include "geometry/Camera.h"
#include "synthesis/SynthesisOptions.h"

#include <optional>
#include <string>

namespace novelview
{
/** A picture that the page wants. */
struct FrameRequest
{
  static constexpr int LargestSidePx = 4096;

  enum class Picture
  {
    Colour,
    Depth,
    Mesh
  };

  Camera Cam;
  Stage UpTo = Stage::Full;
  Picture Show = Picture::Colour;
  std::optional<Eigen::Vector2i> Pick; ///< a pixel whose surface point is wanted, too
};

/**
 * From {"K": 9 numbers, "R": 9, "T": 3, "width": px, "height": px, "stage": word,
 * "show": "colour", "depth" or "mesh", "pick": [x, y]}, matrices row by row; the last two may be
 * missing. Throws Error when anything is missing, of another type, or no valid camera.
 */
FrameRequest ParseFrameRequest(const std::string& text);
}

#endif
