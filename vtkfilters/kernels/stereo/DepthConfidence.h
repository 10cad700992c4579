// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_DepthConfidence_h
#define novelview_DepthConfidence_h

#include "core/Execution.h"
#include "core/ImageRef.h"
#include "geometry/View.h"
#include "stereo/ReferenceDepthOptions.h"

#include <vector>

namespace novelview
{
/**
 * The confidence of each depth of view `viewId` given the maps of all.
 * @param score photo score per pixel, 0 to 1.
 */
Image<float> DepthConfidence(const std::vector<View>& views, int viewId,
  const std::vector<Image<float>>& depths, const Image<float>& score,
  const ReferenceDepthOptions& options, double footprint, const Execution& execution = {});
}

#endif
