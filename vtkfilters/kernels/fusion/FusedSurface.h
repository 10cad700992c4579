// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_FusedSurface_h
#define novelview_FusedSurface_h

#include "core/Execution.h"
#include "fusion/FusedSurfaceOptions.h"
#include "geometry/MeshTopology.h"
#include "geometry/View.h"

#include <vector>

namespace novelview
{
struct FusedSurface
{
  TriangleMesh Mesh; ///< closed, oriented outwards, manifold
  DroppedComponents Dropped;
};

/**
 * The surface of the whole object, for no camera in particular: the zero crossing of TsdfField on a
 * sparse lattice (SparseTsdf).
 *
 *  1. A depth loses confidence at grazing incidence: G cos^GrazingPower.
 *  2. The lattice's seeds are the hull's points and those that the depth maps show.
 *  3. The field is smoothed where the maps say little.
 *  4. The surface net is made, and its largest component kept.
 *
 * Where no photograph sees anything, the hull stays.
 *
 * Views need ContourDistance, DepthMap and Confidence. Throws Error when one is missing, the hull has
 * no points or lies behind every camera, and when the maps leave nothing of the object.
 *
 * Source: Curless and Levoy, "A volumetric method for building complex models from range images",
 * SIGGRAPH 1996.
 */
FusedSurface FuseDepthMaps(const std::vector<Eigen::Vector3d>& hull, const std::vector<View>& views,
  const FusedSurfaceOptions& options = {}, const Execution& execution = {});
}

#endif
