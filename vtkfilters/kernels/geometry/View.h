// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_View_h
#define novelview_View_h

#include "core/Error.h"
#include "core/ImageRef.h"
#include "geometry/Camera.h"

#include <cstdint>
#include <string>
#include <vector>

namespace novelview
{
/**
 * One photograph with its calibration. Pixels are not owned; an array that the data set does not
 * have is an empty reference.
 */
struct View
{
  std::string Name;
  Camera Cam;
  ImageRef<const std::uint8_t> Color;    ///< 3 channels, RGB
  ImageRef<const std::uint8_t> Mask;     ///< above 127 = object
  ImageRef<const float> ContourDistance; ///< signed distance to the silhouette's contour in
                                         ///< pixels, positive inside
  ImageRef<const float> DepthMap;        ///< depth per pixel, 0 = unknown
  ImageRef<const float> Confidence;      ///< of the depth, 0 to 1
  double Gain = 1;                       ///< how much brighter than the photographs' mean

  bool IsObject(int x, int y) const { return this->Mask(x, y) > 127; }
};

/** Throws Error when a view has no depth map or no confidences. */
inline void RequireDepthMaps(const std::vector<View>& views)
{
  for (const View& view : views)
  {
    if (view.DepthMap.Empty() || view.Confidence.Empty())
    {
      throw Error("view " + view.Name, "point array Depth or Confidence is missing");
    }
  }
}
}

#endif
