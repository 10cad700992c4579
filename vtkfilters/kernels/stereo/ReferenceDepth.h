// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ReferenceDepth_h
#define novelview_ReferenceDepth_h

#include "core/Execution.h"
#include "core/ImageRef.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"
#include "stereo/ReferenceDepthOptions.h"

#include <vector>

namespace novelview
{
/** Of one photograph: depth per pixel, 0 where it shows no object, and how sure that is. */
struct ReferenceDepth
{
  Image<float> Depth;
  Image<float> Confidence; ///< 0 to 1
};

/**
 * A depth map in every photograph, each in turn the reference image and its neighbours the secondaries:
 * the paper's triangulated points [7, 8] done for every pixel of every reference.
 *
 *  1. At half resolution, matching behind the hull's front surface with semi-global smoothing.
 *  2. The maps of photographs around each one fused (TsdfField) and seen again from it.
 *  3. At full resolution, matching about that surface.
 *  4. Confidence = photo score x cosine of incidence x agreement with the neighbouring maps.
 *
 * Views need Color, Mask and ContourDistance; `hull` is a closed mesh around the object. Views
 * without neighbours get confidence 0.
 */
std::vector<ReferenceDepth> EstimateReferenceDepths(const std::vector<View>& views,
  const TriangleMesh& hull, const ReferenceDepthOptions& options = {},
  const Execution& execution = {});
}

#endif
