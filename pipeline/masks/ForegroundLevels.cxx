// SPDX-License-Identifier: GPL-3.0-or-later
#include "masks/ForegroundLevels.h"

#include "images/OpenCvPixels.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace novelview
{
namespace
{
/** The components of `candidates` that hold at least one pixel of `sure`. */
cv::Mat ConnectedTo(const cv::Mat& candidates, const cv::Mat& sure)
{
  cv::Mat labels;
  const int count = cv::connectedComponents(candidates, labels, 8);
  std::vector<bool> keep(count, false);
  for (int y = 0; y < labels.rows; ++y)
  {
    for (int x = 0; x < labels.cols; ++x)
    {
      if (sure.at<std::uint8_t>(y, x))
      {
        keep[labels.at<int>(y, x)] = true;
      }
    }
  }
  keep[0] = false;
  cv::Mat result(candidates.size(), CV_8U);
  for (int y = 0; y < labels.rows; ++y)
  {
    for (int x = 0; x < labels.cols; ++x)
    {
      result.at<std::uint8_t>(y, x) = keep[labels.at<int>(y, x)] ? 255 : 0;
    }
  }
  return result;
}

/** Median and median deviation of the border's differences up to a level. */
std::pair<int, int> BackgroundNoise(const cv::Mat& difference, const cv::Mat& border, int upTo)
{
  std::vector<int> background;
  for (int y = 0; y < difference.rows; ++y)
  {
    for (int x = 0; x < difference.cols; ++x)
    {
      const int value = difference.at<std::uint8_t>(y, x);
      if (border.at<std::uint8_t>(y, x) && value <= upTo)
      {
        background.push_back(value);
      }
    }
  }
  if (background.empty())
  {
    return { 0, 0 };
  }
  const auto median = [&background]
  {
    const auto middle = background.begin() + background.size() / 2;
    std::nth_element(background.begin(), middle, background.end());
    return *middle;
  };
  const int noise = median();
  for (int& value : background)
  {
    value = std::abs(value - noise);
  }
  return { noise, median() };
}

/**
 * How well the outline of a mask follows edges: mean over its contour of log(1 + contrast / noise),
 * contrast = range of the difference in the 3 x 3 pixels around. Contour along the frame is none.
 */
double EdgeScore(const cv::Mat& mask, const cv::Mat& contrast, double noise)
{
  cv::Mat inner;
  cv::erode(mask, inner, cv::Mat());
  double sum = 0;
  double count = 0;
  for (int y = 1; y + 1 < mask.rows; ++y)
  {
    for (int x = 1; x + 1 < mask.cols; ++x)
    {
      if (mask.at<std::uint8_t>(y, x) && !inner.at<std::uint8_t>(y, x))
      {
        sum += std::log1p(contrast.at<std::uint8_t>(y, x) / noise);
        count += 1;
      }
    }
  }
  return count > 0 ? sum / count : 0;
}

/**
 * The level whose outline follows the edges of the image best. Too low a level runs through the
 * folds of a backdrop, too high a one through the shading of the object; both are smooth. Among
 * about equals (a tenth) the lowest, which keeps the dark parts.
 */
int LevelAlongEdges(const cv::Mat& difference, int lowest, int high, double noise)
{
  constexpr double aboutEqual = 0.9;
  cv::Mat least;
  cv::Mat most;
  cv::erode(difference, least, cv::Mat());
  cv::dilate(difference, most, cv::Mat());
  const cv::Mat contrast = most - least;
  std::vector<std::pair<int, double>> scores;
  double best = 0;
  for (int level = lowest; level <= high; level += std::max(1, level / 6))
  {
    scores.emplace_back(level, EdgeScore(ObjectAt(difference, level, high), contrast, noise));
    best = std::max(best, scores.back().second);
  }
  for (const auto& [level, score] : scores)
  {
    if (score >= aboutEqual * best)
    {
      return level;
    }
  }
  return high;
}
}

cv::Mat ObjectAt(const cv::Mat& difference, int low, int high)
{
  return LargestComponent(ConnectedTo(difference > low, difference > high));
}

ForegroundLevels ChooseLevels(
  const cv::Mat& difference, const cv::Mat& border, const std::optional<double>& level)
{
  ForegroundLevels levels;
  if (level)
  {
    levels.Low = levels.High = static_cast<int>(std::ceil(*level)) - 1;
    return levels;
  }
  cv::Mat unused;
  levels.High = static_cast<int>(
    cv::threshold(difference, unused, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU));
  const auto [noise, spread] = BackgroundNoise(difference, border, levels.High);
  levels.Noise = noise;
  // Six standard deviations of the noise (1.48 median deviations each), and two levels for what
  // rounding hides.
  const double deviations = 6 * 1.48 * spread + 2;
  const int lowest = std::min(levels.High, noise + static_cast<int>(deviations));
  levels.Low = LevelAlongEdges(difference, lowest, levels.High, deviations);
  return levels;
}
}
