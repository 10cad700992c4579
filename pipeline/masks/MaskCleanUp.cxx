// SPDX-License-Identifier: GPL-3.0-or-later
#include "masks/MaskCleanUp.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace novelview
{
void FillSmallHoles(cv::Mat& mask, double smallHole)
{
  const double limit = smallHole * cv::countNonZero(mask);
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(mask == 0, labels, stats, centroids, 4);
  for (int label = 1; label < count; ++label)
  {
    const int left = stats.at<int>(label, cv::CC_STAT_LEFT);
    const int top = stats.at<int>(label, cv::CC_STAT_TOP);
    const bool open = left == 0 || top == 0 ||
      left + stats.at<int>(label, cv::CC_STAT_WIDTH) == mask.cols ||
      top + stats.at<int>(label, cv::CC_STAT_HEIGHT) == mask.rows;
    if (!open && stats.at<int>(label, cv::CC_STAT_AREA) < limit)
    {
      mask.setTo(255, labels == label);
    }
  }
}

cv::Mat CloseGaps(const cv::Mat& mask, int radiusPx)
{
  if (radiusPx < 1)
  {
    return mask;
  }
  const int size = 2 * radiusPx + 1;
  cv::Mat padded;
  cv::copyMakeBorder(mask, padded, size, size, size, size, cv::BORDER_REPLICATE);
  cv::morphologyEx(padded, padded, cv::MORPH_CLOSE,
    cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(size, size)));
  return padded(cv::Rect(size, size, mask.cols, mask.rows)).clone();
}

cv::Mat SoftenBoundary(const cv::Mat& mask, const cv::Mat& difference, int noise)
{
  // The blur of a photograph: the boundary lies within two pixels of where a low level puts it, and
  // the object's full difference is reached within two more.
  constexpr int rimPx = 2;
  const auto disc = [](int radiusPx)
  {
    return cv::getStructuringElement(
      cv::MORPH_ELLIPSE, cv::Size(2 * radiusPx + 1, 2 * radiusPx + 1));
  };
  cv::Mat outer;
  cv::Mat inner;
  cv::Mat object;
  cv::Mat full;
  cv::dilate(mask, outer, disc(1));
  cv::erode(mask, inner, disc(rimPx));
  cv::bitwise_and(difference, mask, object);
  cv::dilate(object, full, disc(rimPx));
  cv::Mat result = mask.clone();
  for (int y = 0; y < mask.rows; ++y)
  {
    for (int x = 0; x < mask.cols; ++x)
    {
      const int height = full.at<std::uint8_t>(y, x) - noise;
      if (outer.at<std::uint8_t>(y, x) && !inner.at<std::uint8_t>(y, x) && height > 0)
      {
        const double coverage = (difference.at<std::uint8_t>(y, x) - noise) / double(height);
        result.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(coverage, 0.0, 1.0)));
      }
    }
  }
  return result;
}
}
