// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Rasteriser_h
#define novelview_Rasteriser_h

#include "core/Execution.h"
#include "core/ImageRef.h"
#include "geometry/Camera.h"
#include "geometry/DepthImage.h"
#include "geometry/Subsamples.h"
#include "geometry/TriangleMesh.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace novelview
{
class RowTiles;

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
 * Exact in depth (1/z is linear in the image) and the same bits for any number of threads.
 */
ItemBuffer Rasterise(
  const TriangleMesh& mesh, const Camera& camera, const Execution& execution = {});

/** A mesh projected into a camera's frame once, to be rasterised in several ways. */
class ProjectedMesh
{
public:
  /** Mesh and execution must outlive it. */
  ProjectedMesh(const TriangleMesh& mesh, const Camera& camera, const Execution& execution);
  ~ProjectedMesh();

  /** What novelview::Rasterise() makes. */
  ItemBuffer Rasterise() const;

  /** The same with perSide^2 rays through each of the `chosen` pixels. */
  Subsamples RasteriseSubsamples(const Image<std::uint8_t>& chosen, int perSide) const;

private:
  const std::unique_ptr<const RowTiles> Bands;
};
}

#endif
