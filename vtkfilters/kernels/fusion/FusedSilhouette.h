// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_FusedSilhouette_h
#define novelview_FusedSilhouette_h

#include "core/Execution.h"
#include "core/ImageRef.h"
#include "fusion/DepthMapOptions.h"
#include "fusion/SilhouetteSupport.h"
#include "fusion/TsdfField.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"
#include "silhouettes/ContourPrediction.h"

#include <vector>

namespace novelview
{
struct FusedSilhouetteOptions
{
  double StepPx = 2;      ///< of the walk along the novel rays, input pixel footprints
  double SmoothingPx = 0; ///< sigma of the Gaussian over the distances; 0 = none
  /** Whether the contour predicted from the photographs' contours takes part. */
  bool UsePrediction = DepthMapOptions().UsePrediction;
  /** Its most weight against the field's 1. */
  double PredictionWeight = 10;
  double PredictionGatePx = 1;       ///< the weight falls as the two differ by this
  double PredictionResidualPx = 0.1; ///< and as its circle misses the contours by this
  ContourPredictionOptions Prediction;
  /** Points that are object whatever the field says (FindSilhouetteSupport). */
  std::vector<SupportPoint> Support;
  double SupportShare = 0.5; ///< the contour passes them at this share of InsidePx,
  double SupportMaxPx = 3;   ///< of which so much counts
};

/**
 * The silhouette that the fused field shows to the novel camera, inside that of the mesh: signed
 * distance to its contour in novel pixels, positive inside.
 *
 *  1. A pixel of the mesh's silhouette is object when the field along its ray says so
 *     (TsdfField::FindFirstCrossing).
 *  2. Near the contour so found, every pixel takes the signed distance at which its ray passes the
 *     surface (TsdfField::FindClosestApproach): the contour is where that is zero, to a fraction of a pixel.
 *  3. That distance is drawn to the one from the contour predicted from the photographs' contours
 *     (PredictContour), where both agree: depth maps say where the surface is, but only to a
 *     fraction of a pixel that shows at the rim; the prediction is finer where the surface is
 *     smooth, and wrong where it is not.
 *  4. It is at most -SupportShare min(InsidePx, SupportMaxPx) at the projection of each support
 *     point, and rises from there by 1 per pixel: maps do not carve what a silhouette shows.
 *  5. A Gaussian over the distances as wide as the maps are unsure; tiny holes filled, tiny islands
 *     dropped.
 *
 * Views need ContourDistance, DepthMap and Confidence.
 */
Image<float> FusedSilhouette(const TriangleMesh& mesh, const std::vector<View>& views,
  const TsdfField& field, const Camera& novel, double footprint,
  const FusedSilhouetteOptions& options = {}, const Execution& execution = {});
}

#endif
