// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Rasteriser_h
#define novelview_Rasteriser_h

#include "Camera.h"
#include "Execution.h"
#include "ImageRef.h"
#include "TriangleMesh.h"

namespace novelview
{
/** What a camera sees of a mesh, per pixel: the paper's mesh lookup table. */
struct ItemBuffer
{
  Image<int> CellId;  ///< front triangle, -1 = background
  Image<float> Depth; ///< its depth at the pixel's centre; infinity = background

  bool Hit(int x, int y) const { return this->CellId(x, y) >= 0; }
};

/**
 * Rasterises a mesh into a camera's frame. A pixel belongs to a triangle when its centre lies in
 * the projected triangle (edges included); the nearest triangle wins, the lowest id among equals.
 * Triangles of both orientations are drawn. Triangles with a corner at or behind the camera's plane
 * are left out.
 *
 * Exact in depth (1/z is linear in the picture) and the same bits for any number of threads.
 */
ItemBuffer Rasterise(
  const TriangleMesh& mesh, const Camera& camera, const Execution& execution = {});

/**
 * The camera whose picture is `factor` times as large in each direction and covers the same frame:
 * each pixel of `camera` is factor x factor pixels of the result.
 */
Camera Supersampled(const Camera& camera, int factor);
}

#endif
