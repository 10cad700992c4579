// SPDX-License-Identifier: GPL-3.0-or-later
#include "images/OpenCvPixels.h"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace novelview
{
cv::Mat ToBgr(const ImageRef<const std::uint8_t>& pixels)
{
  cv::Mat mat = ToMat(pixels);
  if (pixels.Channels == 3)
  {
    cv::cvtColor(mat, mat, cv::COLOR_RGB2BGR);
  }
  return mat;
}

cv::Mat Shrunk(const cv::Mat& mat, const cv::Size& within)
{
  const double scale = std::min({ 1.0, within.width / static_cast<double>(mat.cols),
    within.height / static_cast<double>(mat.rows) });
  const cv::Size size(std::max(1, static_cast<int>(std::lround(scale * mat.cols))),
    std::max(1, static_cast<int>(std::lround(scale * mat.rows))));
  cv::Mat shrunk;
  cv::resize(mat, shrunk, size, 0, 0, cv::INTER_AREA);
  return shrunk;
}

cv::Mat LargestComponent(const cv::Mat& mask)
{
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centroids, 8);
  int largest = 0;
  for (int label = 1; label < count; ++label)
  {
    if (largest == 0 ||
      stats.at<int>(label, cv::CC_STAT_AREA) > stats.at<int>(largest, cv::CC_STAT_AREA))
    {
      largest = label;
    }
  }
  return largest > 0 ? cv::Mat(labels == largest) : cv::Mat(cv::Mat::zeros(mask.size(), CV_8U));
}
}
