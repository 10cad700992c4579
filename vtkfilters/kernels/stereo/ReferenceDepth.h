// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ReferenceDepth_h
#define novelview_ReferenceDepth_h

#include "core/Execution.h"
#include "fusion/TsdfField.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"
#include "stereo/CostVolume.h"
#include "stereo/ReferenceDepthParameters.h"

#include <vector>

namespace novelview
{
struct ReferenceDepthOptions
{
  /** Photographs each is matched with, the nearest in angle. */
  int Neighbours = ReferenceDepthParameters::Neighbours.Default;
  double MaxAngleDeg = 65;     ///< and no further than this
  double CoarseFirstPx = -1.5; ///< first pass: offsets behind the hull's front, pixel footprints
  double CoarseLastPx = ReferenceDepthParameters::CoarseLastPx.Default;
  double CoarseStepPx = 4;
  int FusedViews = 16;     ///< maps fused as one photograph sees them: its own and the nearest
  double FineRangePx = 24; ///< second pass: offsets about the fused surface, each way
  double FineStepPx = 2;
  double AgreementPx = 4; ///< depths of two photographs agree within this
  int AgreementViews = 6; ///< looked at for agreement, the nearest in angle
  MatchOptions Match;
  SemiGlobalOptions SemiGlobal;
  FusionOptions Fusion;
};

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

// ---- parts, for tests and reuse -------------------------------------------------------------------

/** Median over the (2 radius + 1)^2 window's values above 0; 0 stays 0. */
Image<float> MaskedMedian(const Image<float>& image, int radius);

/**
 * The confidence of each depth of view `viewId` given the maps of all.
 * @param score photo score per pixel, 0 to 1.
 */
Image<float> DepthConfidence(const std::vector<View>& views, int viewId,
  const std::vector<Image<float>>& depths, const Image<float>& score,
  const ReferenceDepthOptions& options, double footprint, const Execution& execution = {});
}

#endif
