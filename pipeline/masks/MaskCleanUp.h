// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the silhouettes.
#ifndef novelview_MaskCleanUp_h
#define novelview_MaskCleanUp_h

#include <opencv2/core.hpp>

namespace novelview
{
/** Fills the enclosed background components below a part of the object's area. */
void FillSmallHoles(cv::Mat& mask, double smallHole);

/** Closing that treats the frame as neither object nor background. */
cv::Mat CloseGaps(const cv::Mat& mask, int radiusPx);

/**
 * Coverage near the mask's boundary: the difference over the largest one of the object close by, so
 * that 0.5 is the half height of the edge. Elsewhere the mask itself.
 */
cv::Mat SoftenBoundary(const cv::Mat& mask, const cv::Mat& difference, int noise);
}

#endif
