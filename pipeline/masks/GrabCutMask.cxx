// SPDX-License-Identifier: GPL-3.0-or-later
#include "masks/GrabCutMask.h"

#include "core/Error.h"
#include "core/ToInt.h"
#include "images/OpenCvPixels.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
constexpr int WorkingSize = 640; ///< px; GrabCut's time grows faster than the number of pixels

cv::Rect BoxIn(const cv::Mat& photo, const std::array<double, 4>& box, double scale)
{
  const auto x = [&](double value)
  { return RoundToInt(ClampedNumber(value * scale, 0, photo.cols)); };
  const auto y = [&](double value)
  { return RoundToInt(ClampedNumber(value * scale, 0, photo.rows)); };
  const cv::Point low(x(box[0]), y(box[1]));
  const cv::Point high(x(box[2]), y(box[3]));
  return cv::Rect(low, high) & cv::Rect(cv::Point(0, 0), photo.size());
}

/** The largest component of a mask with its small holes filled; empty when there is none. */
cv::Mat OneObject(const cv::Mat& mask, double smallHole)
{
  cv::Mat object = LargestComponent(mask);
  const int area = cv::countNonZero(object);
  if (area == 0)
  {
    return {};
  }
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const int holes = cv::connectedComponentsWithStats(object == 0, labels, stats, centroids, 4);
  for (int label = 1; label < holes; ++label)
  {
    if (stats.at<int>(label, cv::CC_STAT_AREA) < smallHole * area)
    {
      object.setTo(255, labels == label);
    }
  }
  return object;
}
}

std::array<double, 4> CentralBox(int width, int height, double margin)
{
  return { margin * width, margin * height, (1 - margin) * width, (1 - margin) * height };
}

Image<std::uint8_t> GrabCutSilhouette(
  const ImageRef<const std::uint8_t>& photo, const GrabCutOptions& options)
{
  const cv::Mat whole = ToMat(photo);
  const double scale =
    std::min(1.0, WorkingSize / static_cast<double>(std::max(whole.cols, whole.rows)));
  cv::Mat pixels = whole;
  if (scale < 1)
  {
    cv::resize(whole, pixels, cv::Size(), scale, scale, cv::INTER_AREA);
  }
  const cv::Rect box = BoxIn(pixels, options.Box, scale);
  constexpr int MinPixels = 16; // GrabCut learns five colours of each side
  if (box.area() < MinPixels || pixels.size().area() - box.area() < MinPixels)
  {
    throw Error("box", "must contain a part of the photograph and exclude one",
      SizeText(box.width, box.height) + " of " + SizeText(pixels.cols, pixels.rows),
      "at least 16 pixels of each");
  }
  // Its colours start from clusters that are drawn at random.
  cv::theRNG().state = 0x9e3779b97f4a7c15;
  cv::Mat labels;
  cv::Mat background;
  cv::Mat foreground;
  cv::grabCut(pixels, labels, box, background, foreground, options.Rounds, cv::GC_INIT_WITH_RECT);
  cv::Mat object = OneObject((labels & 1) != 0, options.SmallHole);
  if (object.empty())
  {
    throw Error("box", "nothing in it differs from what surrounds it");
  }
  if (scale < 1)
  {
    cv::resize(object, object, whole.size(), 0, 0, cv::INTER_LINEAR);
  }
  return FromMat<std::uint8_t>(object);
}
}
