// SPDX-License-Identifier: GPL-3.0-or-later
#include "masks/FaintParts.h"

#include "core/Quantile.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstdint>
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

cv::Mat Grown(const cv::Mat& mask, int radiusPx)
{
  cv::Mat grown;
  cv::dilate(mask, grown,
    cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * radiusPx + 1, 2 * radiusPx + 1)));
  return grown;
}

/** Largest of the channels. */
cv::Mat LargestChannel(const cv::Mat& values)
{
  std::vector<cv::Mat> channels;
  cv::split(values, channels);
  return cv::max(cv::max(channels[0], channels[1]), channels[2]);
}

/** Upper quartile of what a blur of 1 px takes away. */
double FineDetail(const cv::Mat& detail, const cv::Mat& where)
{
  std::vector<double> values;
  for (int y = 0; y < detail.rows; ++y)
  {
    for (int x = 0; x < detail.cols; ++x)
    {
      if (where.at<std::uint8_t>(y, x))
      {
        values.push_back(detail.at<float>(y, x));
      }
    }
  }
  return Quantile(std::move(values), 0.75);
}

/**
 * By how much the photograph is noisier next to the object than along the border: lossy compression
 * spoils the blocks that hold an edge, and leaves a plain background as it is. 0 = no such noise.
 */
double CompressionNoise(
  const cv::Mat& photo, const cv::Mat& mask, const cv::Mat& outside, const cv::Mat& ground)
{
  constexpr int blockPx = 8; // of JPEG; every block that an edge touches is noisy
  cv::Mat colour;
  cv::Mat blurred;
  photo.convertTo(colour, CV_32F);
  cv::GaussianBlur(colour, blurred, cv::Size(), 1);
  const cv::Mat detail = LargestChannel(cv::abs(colour - blurred));
  const cv::Mat beside = Grown(mask > 127, blockPx) & outside;
  return std::max(0.0, FineDetail(detail, beside) - FineDetail(detail, ground));
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
  constexpr int compressedPx = 16; // JPEG's blocks of halved colours
  // Smoothing leaves at most so much of the compression's noise: its largest was six times, over
  // qualities from 75 up and five objects.
  constexpr double smoothedCompression = 8;
  const cv::Mat near = Grown(mask, blurPx);
  const cv::Mat outside = near == 0;
  const cv::Mat ground = outside & border;
  const double objectArea = cv::countNonZero(mask > 127);
  if (cv::countNonZero(ground) == 0 || objectArea == 0)
  {
    return;
  }
  const cv::Mat smooth = SmoothOutside(photo, outside, smoothingPx);
  const cv::Mat background(photo.size(), CV_32FC3, cv::mean(smooth, ground));
  const cv::Mat difference = LargestChannel(cv::abs(smooth - background));
  const auto [noise, deviation] = ClippedNoise(difference, ground);
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  // Six deviations of the smoothed noise, and half a level that rounding may hide.
  const double least = noise + 6 * deviation + 0.5;
  cv::Mat limit(photo.size(), CV_32F, cv::Scalar(least));
  limit.setTo(least + smoothedCompression * CompressionNoise(photo, mask, outside, ground),
    Grown(mask > 127, compressedPx));
  const cv::Mat faint = outside & (difference > limit);
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
