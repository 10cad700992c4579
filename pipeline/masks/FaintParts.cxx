// SPDX-License-Identifier: GPL-3.0-or-later
#include "masks/FaintParts.h"

#include <opencv2/imgproc.hpp>

#include <utility>
#include <vector>

namespace novelview
{
namespace
{
/** Mean colour of the background-to-be around every pixel, without the object's own light. */
cv::Mat SmoothOutside(const cv::Mat& photo, const cv::Mat& outside, double sigmaPx)
{
  cv::Mat weight;
  cv::Mat colour;
  outside.convertTo(weight, CV_32F, 1.0 / 255);
  photo.convertTo(colour, CV_32F);
  colour.setTo(cv::Scalar::all(0), outside == 0);
  cv::GaussianBlur(weight, weight, cv::Size(), sigmaPx, sigmaPx, cv::BORDER_REFLECT);
  cv::GaussianBlur(colour, colour, cv::Size(), sigmaPx, sigmaPx, cv::BORDER_REFLECT);
  cv::Mat weights;
  cv::merge(std::vector<cv::Mat>(3, cv::max(weight, 1e-6)), weights);
  return colour / weights;
}

/** Mean and standard deviation of what lies within three deviations of the rest, a few rounds. */
std::pair<double, double> ClippedNoise(const cv::Mat& values, const cv::Mat& where)
{
  cv::Mat used = where.clone();
  cv::Scalar mean;
  cv::Scalar deviation;
  for (int round = 0; round < 5; ++round)
  {
    cv::meanStdDev(values, mean, deviation, used);
    used = where & (values <= mean[0] + 3 * deviation[0]);
  }
  return { mean[0], deviation[0] };
}

int PixelsAtFrame(const cv::Mat& mask)
{
  return cv::countNonZero(mask.row(0)) + cv::countNonZero(mask.row(mask.rows - 1)) +
    cv::countNonZero(mask.col(0)) + cv::countNonZero(mask.col(mask.cols - 1));
}
}

void AddFaintParts(cv::Mat& mask, const cv::Mat& photo, const cv::Mat& border)
{
  constexpr double smoothingPx = 2;
  constexpr int blurPx = 3;        // how far the light of the object may reach by blur
  constexpr double minArea = 0.01; // of the object; smaller regions are reflections
  cv::Mat near;
  cv::dilate(mask, near,
    cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * blurPx + 1, 2 * blurPx + 1)));
  const cv::Mat outside = near == 0;
  const cv::Mat ground = outside & border;
  const double objectArea = cv::countNonZero(mask > 127);
  if (cv::countNonZero(ground) == 0 || objectArea == 0)
  {
    return;
  }
  const cv::Mat smooth = SmoothOutside(photo, outside, smoothingPx);
  const cv::Mat background(photo.size(), CV_32FC3, cv::mean(smooth, ground));
  std::vector<cv::Mat> channels;
  cv::split(cv::abs(smooth - background), channels);
  const cv::Mat difference = cv::max(cv::max(channels[0], channels[1]), channels[2]);
  const auto [noise, deviation] = ClippedNoise(difference, ground);
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  // Six deviations of the smoothed noise, and half a level that rounding may hide.
  const cv::Mat faint = outside & (difference > noise + 6 * deviation + 0.5);
  const int count = cv::connectedComponentsWithStats(faint, labels, stats, centroids, 4);
  cv::Mat touching;
  cv::dilate(near, touching, cv::Mat());
  for (int label = 1; label < count; ++label)
  {
    cv::Mat region = labels == label;
    if (stats.at<int>(label, cv::CC_STAT_AREA) < minArea * objectArea ||
      PixelsAtFrame(region) > PixelsAtFrame(mask) || cv::countNonZero(region & touching) == 0)
    {
      continue;
    }
    // Its boundary, too, is at half its height.
    const double height = cv::mean(difference, region)[0] - noise;
    region &= difference > noise + height / 2;
    // What lies between the region and the object was too near to the object's light to judge.
    cv::Mat seam;
    cv::dilate(region, seam, cv::Mat(), cv::Point(-1, -1), blurPx + 1);
    mask.setTo(255, region | (seam & near & (mask < 128)));
  }
}
}
