// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SilhouetteSupport_h
#define novelview_SilhouetteSupport_h

#include "core/Execution.h"
#include "fusion/TsdfField.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"

#include <vector>

namespace novelview
{
/** A point that must be object because a silhouette says so. */
struct SupportPoint
{
  Eigen::Vector3d Position;
  double InsidePx; ///< how far inside the silhouette that asks for it, pixels of its photograph
};

struct SilhouetteSupportOptions
{
  double FirstPx = 1; ///< pixels so far inside a contour are looked at first,
  double RingPx = 1;  ///< in a ring as wide as this,
  double LastPx = 8;  ///< and from those that miss the object, further ones to this depth
  /**
   * No point is asked for where even this prior (FusionOptions::SilhouettePrior) would not make
   * the ray meet object: there several depth maps see clearly past the silhouette.
   */
  double MaxPrior = 1;
  double AgreementPx = 4; ///< points of neighbouring pixels lie about as deep, pixel footprints;
  int MinAgreeing = 1;    ///< so many of the eight around must, and half of those there are
};

/**
 * Where the fused depth maps carve more than the silhouettes allow. The ray of every pixel inside a
 * silhouette meets the object somewhere (exact silhouette constraint, Sinha and Pollefeys 2005). At
 * thin parts and where there is little to match, depth maps are wrong together and the field says
 * that such a ray is free. The point of the ray that the maps contradict least is then a point of the
 * object, if those of the pixels around lie about as deep: scattered points say that the maps do not
 * tell where on their rays the object is, and would be spikes.
 *
 * Views need ContourDistance, DepthMap and Confidence; `hull` is a closed mesh around the object.
 */
std::vector<SupportPoint> FindSilhouetteSupport(const std::vector<View>& views,
  const TsdfField& field, const TriangleMesh& hull, double footprint,
  const SilhouetteSupportOptions& options = {}, const Execution& execution = {});
}

#endif
