// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the silhouettes.
#ifndef novelview_FaintParts_h
#define novelview_FaintParts_h

#include <opencv2/core.hpp>

namespace novelview
{
/**
 * Adds the parts of the object that lie in such deep shadow that single pixels drown in the noise:
 * smoothed, they still differ from the background. Taken are large regions next to the object that
 * reach the frame no more than the object itself does, which folds of a backdrop do.
 */
void AddFaintParts(cv::Mat& mask, const cv::Mat& photo, const cv::Mat& border);
}

#endif
