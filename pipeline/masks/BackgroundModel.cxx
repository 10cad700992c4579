// SPDX-License-Identifier: GPL-3.0-or-later
#include "masks/BackgroundModel.h"

#include "core/Error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace novelview
{
namespace
{
using Pixel = cv::Vec3b;

/** Width of the border that the background's colour is learnt from. */
int BorderPx(const cv::Mat& photo)
{
  return std::max(2, std::min(photo.cols, photo.rows) / 50);
}

int Difference(const Pixel& a, const cv::Vec3d& b)
{
  double largest = 0;
  for (int channel = 0; channel < 3; ++channel)
  {
    largest = std::max(largest, std::abs(a[channel] - b[channel]));
  }
  return static_cast<int>(std::lround(largest));
}

/** Mean of the colours within `radius` levels of `around`. */
cv::Vec3d MeanAround(const std::vector<Pixel>& colours, const cv::Vec3d& around, int radius)
{
  cv::Vec3d sum(0, 0, 0);
  double count = 0;
  for (const Pixel& colour : colours)
  {
    if (Difference(colour, around) <= radius)
    {
      sum += cv::Vec3d(colour);
      count += 1;
    }
  }
  return count > 0 ? sum / count : around;
}

/** Cb and Cr of JPEG, about 0. */
cv::Vec2d ChromaOf(const cv::Vec3d& rgb)
{
  const double luma = 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
  return { 0.564 * (rgb[2] - luma), 0.713 * (rgb[0] - luma) };
}
}

cv::Mat BorderMask(const cv::Mat& photo)
{
  cv::Mat border(photo.size(), CV_8U, cv::Scalar(255));
  const int width = BorderPx(photo);
  const cv::Rect middle(width, width, photo.cols - 2 * width, photo.rows - 2 * width);
  if (middle.width > 0 && middle.height > 0)
  {
    border(middle).setTo(0);
  }
  return border;
}

cv::Vec3d BackgroundColour(const cv::Mat& photo, const cv::Mat& border, int limit)
{
  constexpr int binLevels = 16;
  std::vector<Pixel> colours;
  std::map<int, int> bins;
  for (int y = 0; y < photo.rows; ++y)
  {
    for (int x = 0; x < photo.cols; ++x)
    {
      if (border.at<std::uint8_t>(y, x))
      {
        const Pixel& colour = photo.at<Pixel>(y, x);
        if (std::max({ colour[0], colour[1], colour[2] }) >= limit)
        {
          continue;
        }
        colours.push_back(colour);
        ++bins[colour[0] / binLevels * 256 + colour[1] / binLevels * 16 + colour[2] / binLevels];
      }
    }
  }
  if (bins.empty())
  {
    throw Error("background", "nothing along the photograph's border is dark",
      "no colour below " + std::to_string(limit), "a dark background");
  }
  const auto fullest = std::max_element(
    bins.begin(), bins.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const int bin = fullest->first;
  const cv::Vec3i cell(bin / 256, bin / 16 % 16, bin % 16);
  cv::Vec3d colour = (cv::Vec3d(cell) + cv::Vec3d(0.5, 0.5, 0.5)) * binLevels;
  for (int step = 0; step < 5; ++step)
  {
    colour = MeanAround(colours, colour, binLevels);
  }
  return colour;
}

cv::Mat DifferenceFrom(const cv::Mat& photo, const cv::Vec3d& background, bool shadows)
{
  // From here on a colour is clear enough to recognise its shades, and a cast shadow still has
  // some light: no shadow outdoors or in a studio is darker than a quarter.
  constexpr double clearChroma = 48;
  constexpr double darkestShadow = 0.25;
  const auto [least, most] = std::minmax({ background[0], background[1], background[2] });
  shadows = shadows && most - least >= clearChroma;
  cv::Mat difference(photo.size(), CV_8U);
  for (int y = 0; y < photo.rows; ++y)
  {
    for (int x = 0; x < photo.cols; ++x)
    {
      const Pixel& colour = photo.at<Pixel>(y, x);
      const double shade = cv::Vec3d(colour).dot(background) / background.dot(background);
      const bool shadow = shadows && shade < 1 && shade > darkestShadow;
      difference.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(
        Difference(colour, shadow ? cv::Vec3d(background * shade) : background));
    }
  }
  return difference;
}

cv::Mat ChromaDifferenceFrom(const cv::Mat& photo, const cv::Vec3d& key)
{
  constexpr double minChroma = 20; // less is grey to a camera with noise and white balance
  constexpr double darkestShade = 0.35;
  constexpr double brightestShade = 1.15;
  const cv::Vec2d chroma = ChromaOf(key);
  const double size = std::sqrt(chroma.dot(chroma));
  if (size < minChroma)
  {
    throw Error("background", "its colour has no hue that distinguishes the object",
      "chroma " + std::to_string(std::lround(size)),
      "at least " + std::to_string(std::lround(minChroma)));
  }
  cv::Mat difference(photo.size(), CV_8U);
  for (int y = 0; y < photo.rows; ++y)
  {
    for (int x = 0; x < photo.cols; ++x)
    {
      const cv::Vec2d seen = ChromaOf(cv::Vec3d(photo.at<Pixel>(y, x)));
      const double shade =
        std::clamp(seen.dot(chroma) / chroma.dot(chroma), darkestShade, brightestShade);
      const cv::Vec2d off = seen - shade * chroma;
      difference.at<std::uint8_t>(y, x) =
        cv::saturate_cast<std::uint8_t>(2 * std::sqrt(off.dot(off)));
    }
  }
  return difference;
}
}
