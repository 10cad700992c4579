// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the silhouettes: from which difference on a pixel is object.
#ifndef novelview_ForegroundLevels_h
#define novelview_ForegroundLevels_h

#include <opencv2/core.hpp>

#include <optional>

namespace novelview
{
/** Thresholds on the difference from the background that separate the object from it. */
struct ForegroundLevels
{
  int Noise = 0; ///< median of the background's own differences
  int Low = 0;   ///< above it and connected to what is surely object: object
  int High = 0;  ///< above it: surely object
};

/** `level` for both when it is given, else what suits the differences best. */
ForegroundLevels ChooseLevels(
  const cv::Mat& difference, const cv::Mat& border, const std::optional<double>& level);

/** The largest component of what is above `low` and connected to what is above `high`. */
cv::Mat ObjectAt(const cv::Mat& difference, int low, int high);
}

#endif
