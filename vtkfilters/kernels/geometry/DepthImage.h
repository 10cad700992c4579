// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_DepthImage_h
#define novelview_DepthImage_h

#include "core/ImageRef.h"
#include "geometry/Camera.h"
#include "geometry/TriangleMesh.h"

#include <limits>

namespace novelview
{
/** The depth of a background pixel that is drawn. */
inline constexpr float NoDepth = std::numeric_limits<float>::infinity();

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

/**
 * Whether a point before a camera is hidden by less than `tolerancePx` pixel footprints by what the
 * camera's depth image shows.
 */
bool IsUnoccluded(const ImageRef<const float>& depth, const Camera& camera,
  const Eigen::Vector3d& point, double tolerancePx);
}

#endif
