// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CoveredBuffer_h
#define novelview_CoveredBuffer_h

#include "core/Execution.h"
#include "geometry/Rasteriser.h"
#include "geometry/Subsamples.h"
#include "geometry/TriangleMesh.h"

#include <Eigen/Core>

#include <vector>

namespace novelview
{
/** How much of a pixel the mesh covers, and which subsample gave the pixel its depth. */
struct RimCoverage
{
  float Covered; ///< 0 to 1
  int Column;
  int Row;
};

/**
 * Item buffer with the share of each pixel that the mesh covers. A pixel whose centre is missed but
 * of which half is covered takes the hit subsample nearest the centre.
 */
struct CoveredBuffer
{
  ItemBuffer Front;
  Subsamples Rays;              ///< through the pixels next to which another is not hit as they are
  std::vector<RimCoverage> Rim; ///< of those pixels

  /** How much of a pixel is covered, 0 to 1. */
  float Covered(int x, int y) const
  {
    const int rim = this->Rays.Index(x, y);
    return rim >= 0 ? this->Rim[rim].Covered : (this->Front.Hit(x, y) ? 1.f : 0.f);
  }

  /** The point of a pixel's square that its depth belongs to. */
  Eigen::Vector2d Place(int x, int y) const
  {
    const int rim = this->Rays.Index(x, y);
    if (rim < 0)
    {
      return Eigen::Vector2d(x, y);
    }
    const RimCoverage& found = this->Rim[rim];
    return { x + this->Rays.Grid.Offset[found.Column], y + this->Rays.Grid.Offset[found.Row] };
  }
};

/** Rasterises the mesh with `samples` subsamples per side in pixels at its boundary; 1 = none. */
CoveredBuffer RasteriseCovered(
  const TriangleMesh& mesh, const Camera& camera, int samples, const Execution& execution);
}

#endif
