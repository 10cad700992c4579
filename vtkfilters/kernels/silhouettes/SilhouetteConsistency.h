// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SilhouetteConsistency_h
#define novelview_SilhouetteConsistency_h

#include "core/Execution.h"
#include "geometry/View.h"
#include "silhouettes/ConsistencyOptions.h"

#include <vector>

namespace novelview
{
/**
 * By how many pixels each silhouette is too small, judged by all others; 0 in a set that agrees.
 *
 * The ray through a pixel at the edge of one silhouette touches the object, so that somewhere along
 * it every other silhouette should contain it. Where the best such point lies outside just one,
 * by e pixels, that one is the outlier. A silhouette that is the outlier of far more rays than
 * others is too small by the ninth decile of its e.
 *
 * The intersection of silhouettes forgives one that is too large, and never one that is too small.
 * Where masks or cameras are off by a little in all views, it is therefore too small everywhere; half
 * of the ninth decile of what stands against a silhouette's rays (median over the views) is given
 * back to all.
 *
 * Views need Mask and ContourDistance. All 0 when the silhouettes bound no box (FindSearchBox);
 * the code that needs the box reports that.
 */
std::vector<double> FindContourOffsets(const std::vector<View>& views,
  const ConsistencyOptions& options = {}, const Execution& execution = {});
}

#endif
