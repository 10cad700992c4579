// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the silhouettes: what the background looks like, and how far a pixel is from it.
#ifndef novelview_BackgroundModel_h
#define novelview_BackgroundModel_h

#include <opencv2/core.hpp>

namespace novelview
{
/** 255 along the border that the background's colour is learnt from, 0 inside. */
cv::Mat BorderMask(const cv::Mat& photo);

/**
 * The most frequent colour of the border: the fullest bin, then a few steps of mean shift. Only
 * colours with no channel at `limit` or above count. Throws Error when there are none.
 */
cv::Vec3d BackgroundColour(const cv::Mat& photo, const cv::Mat& border, int limit = 256);

/**
 * Difference from the background, 8 bits. With `shadows`, a pixel c is split into the shade of the
 * background s b that is nearest to it and a rest; for a plausible shadow only the rest counts.
 */
cv::Mat DifferenceFrom(const cv::Mat& photo, const cv::Vec3d& background, bool shadows);

/**
 * Difference from the key's hue, 8 bits: twice the distance in the chroma plane from the nearest of
 * the key's shades, which are from a third of its chroma to a little more than all of it. Throws Error
 * when the key has no hue.
 */
cv::Mat ChromaDifferenceFrom(const cv::Mat& photo, const cv::Vec3d& key);
}

#endif
