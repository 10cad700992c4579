// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SilhouetteConsistency_h
#define novelview_SilhouetteConsistency_h

#include "core/Execution.h"
#include "geometry/View.h"
#include "silhouettes/ConsistencyParameters.h"

#include <vector>

namespace novelview
{
struct ConsistencyOptions
{
  int RaysPerView = 300; ///< about so many rays of each silhouette's contour are followed, and
  int RaysOfAll = 7200;  ///< not many more than so many in all, since each meets every view
  /** Smaller offsets are left alone, and so is what disagrees by less. */
  double MinPx = ConsistencyParameters::MinPx.Default;
  /** Part of the others' rays that a silhouette has to cut. */
  double MinShare = ConsistencyParameters::MinShare.Default;
  double Outstanding = 3;  ///< and so many times the median silhouette's part
  int Rounds = 5;          ///< at most, each with what the last one found put right
  double MaxSlackPx = 0.6; ///< what all are enlarged by at most
};

/**
 * By how many pixels each silhouette is too small, judged by all others; 0 in a set that agrees.
 *
 * The ray through a pixel at the edge of one silhouette touches the object, so that somewhere along
 * it every other silhouette should say "inside". Where the best such point lies outside just one,
 * by e pixels, that one is blamed. A silhouette that is blamed by far more rays than others are is
 * too small by the ninth decile of its e.
 *
 * The intersection of silhouettes forgives one that is too large, and never one that is too small.
 * Where masks or cameras are off by a little in all views, it is therefore too small everywhere; half
 * of the ninth decile of what stands against a silhouette's rays (median over the views) is given
 * back to all.
 *
 * Views need Mask and ContourDistance. All 0 when the silhouettes bound no box (FindSearchBox);
 * whoever needs the box reports that.
 */
std::vector<double> FindContourOffsets(const std::vector<View>& views,
  const ConsistencyOptions& options = {}, const Execution& execution = {});
}

#endif
