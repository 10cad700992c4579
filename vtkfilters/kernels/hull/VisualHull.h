// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_VisualHull_h
#define novelview_VisualHull_h

#include "core/Execution.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"
#include "hull/VisualHullOptions.h"

#include <Eigen/Geometry>

#include <vector>

namespace novelview
{
struct VisualHullResult
{
  OrientedPoints Samples;  ///< on f = 0, with outward unit normals
  TriangleMesh Surface;    ///< through all samples, of before the thinning (ConnectCells)
  Eigen::AlignedBox3d Box; ///< the box searched
  bool CutByBox = false;   ///< the hull ends at faces of the given box
  double Spacing = 0;      ///< world units
  int Components = 0;      ///< found
  int DroppedComponents = 0;
  std::size_t DroppedSamples = 0;
};

/**
 * Surface samples of the visual hull, the set f >= 0 of SilhouetteField: an octree finds the blocks
 * that the surface may pass through, every lattice cell of such a block with corners on both sides
 * gives one sample, which is moved onto f = 0 along the gradient and by bisection; of samples with
 * like normals that are closer than 0.7 spacings the later ones are left out.
 *
 * Views need Mask and ContourDistance. Throws Error when the hull is empty (naming the view that
 * empties it) or reaches the box that was found (the silhouettes do not bound the object there). A
 * given box bounds the hull: what reaches beyond is cut at its faces.
 */
VisualHullResult ComputeVisualHull(const std::vector<View>& views,
  const VisualHullOptions& options = {}, const Execution& execution = {});
}

#endif
