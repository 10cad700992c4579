// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SyntheticRenderer_h
#define novelview_SyntheticRenderer_h

#include "core/ImageRef.h"
#include "drawing/SolidTexture.h"
#include "geometry/Camera.h"

#include <vtkPolyData.h>

#include <cstdint>
#include <memory>

namespace novelview
{
/** A rendered photograph of an object before a black background. */
struct RenderedPhotograph
{
  Image<std::uint8_t>
    Color; ///< RGB; at the silhouette boundary blended with the background by coverage
  Image<std::uint8_t> Coverage; ///< how much of the pixel the object covers: 0 none, 255 all
};

/**
 * Takes photographs of one object with exactly calibrated cameras: a pixel (u, v) is the mean of
 * supersampling^2 samples spread evenly over [u - 0.5, u + 0.5) x [v - 0.5, v + 0.5), rendered by
 * VTK through OSMesa. The image is rendered in tiles, so that any size needs little memory.
 */
class SyntheticRenderer
{
public:
  /** Throws Error on an unknown texture, and when nothing can be rendered. */
  SyntheticRenderer(vtkPolyData* mesh, const SurfaceLook& look, int supersampling);
  ~SyntheticRenderer();

  /**
   * Throws Error when the camera is invalid or does not have the whole object in front of it.
   * `shadow` as in SetShadow().
   */
  RenderedPhotograph Take(const Camera& camera, double shadow = 0);

  /** For the log. */
  const std::string& RendererName() const;

private:
  class Internals;
  std::unique_ptr<Internals> Impl;
};
}

#endif
