// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Rasteriser_h
#define novelview_Rasteriser_h

#include "core/Execution.h"
#include "core/ImageRef.h"
#include "geometry/Camera.h"
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
 * Exact in depth (1/z is linear in the picture) and the same bits for any number of threads.
 */
ItemBuffer Rasterise(
  const TriangleMesh& mesh, const Camera& camera, const Execution& execution = {});

/** The depths of Rasterise(), in one thread: for loops over cameras that are themselves parallel. */
Image<float> RasteriseDepth(const TriangleMesh& mesh, const Camera& camera);

/** Between which depths a mesh lies, per pixel. */
struct DepthRange
{
  Image<float> Nearest;  ///< infinity = background
  Image<float> Farthest; ///< 0 = background
};

/** The same for the nearest and the farthest of all triangles over a pixel. */
DepthRange RasteriseRange(const TriangleMesh& mesh, const Camera& camera);

/**
 * How much deeper a point at depth z that projects to `pixel` lies than the surface a depth image
 * shows there, world units; negative = in front. The surface is the deepest of the 3x3 pixels
 * around, since at a slanted surface neighbours differ by more than any sensible tolerance.
 * Minus infinity where the depth image is empty (0 or infinity) or the pixel is outside it.
 */
double OcclusionDepth(const ImageRef<const float>& depth, const Eigen::Vector2d& pixel, double z);

/** An evenly spaced grid of rays through a pixel, PerSide x PerSide. */
struct SubsampleGrid
{
  int PerSide;
  int Stride; ///< PerSide up to a multiple of four; the rays beyond hit nothing
  /** Where ray i of a row, or row i, lies from the pixel's centre, pixels; Stride of them. */
  std::vector<double> Offset;

  explicit SubsampleGrid(int perSide);
};

/** What a grid of rays through each of some pixels hits. */
struct Subsamples
{
  SubsampleGrid Grid;
  int Pixels = 0;   ///< how many have subsamples
  Image<int> Index; ///< which of them a pixel is, -1 = none
  /** From First() on, PerSide rows of Stride: front triangle (-1 = background) and its depth. */
  std::vector<int> CellId;
  std::vector<float> Depth;

  /** Subsamples through the pixels that are not 0 in `chosen`; they hit nothing yet. */
  Subsamples(const Image<std::uint8_t>& chosen, int perSide);

  /** The first subsample of a pixel that has some. */
  std::size_t First(int x, int y) const
  {
    return static_cast<std::size_t>(this->Index(x, y)) * this->Grid.PerSide * this->Grid.Stride;
  }
};

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
