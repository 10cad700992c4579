// SPDX-License-Identifier: GPL-3.0-or-later
#include "images/MaskImage.h"

#include "base/NumberText.h"
#include "core/Error.h"
#include "images/DecodedPicture.h"
#include "images/OpenCvPixels.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace novelview
{
namespace
{
std::pair<double, double> RangeOf(const cv::Mat& channel)
{
  double least = 0;
  double most = 0;
  cv::minMaxLoc(channel, &least, &most);
  return { least, most };
}

bool IsConstant(const cv::Mat& channel)
{
  const auto [least, most] = RangeOf(channel);
  return least == most;
}

/** One channel of the file's depth, and whether it was made from different colours. */
std::pair<cv::Mat, bool> ChannelOf(const cv::Mat& mat)
{
  std::vector<cv::Mat> channels;
  cv::split(mat, channels);
  const bool alpha = channels.size() == 2 || channels.size() == 4;
  const std::size_t colours = alpha ? channels.size() - 1 : channels.size();
  const bool flat = std::all_of(
    channels.begin(), channels.begin() + static_cast<std::ptrdiff_t>(colours), IsConstant);
  if (alpha && flat && !IsConstant(channels.back()))
  {
    return { channels.back(), false };
  }
  cv::Mat most = channels[0];
  bool coloured = false;
  for (std::size_t i = 1; i < colours; ++i)
  {
    coloured |= cv::countNonZero(channels[i] != channels[0]) > 0;
    most = cv::max(most, channels[i]);
  }
  return { most, coloured };
}

/** The value of a white pixel, by the depth of the file and the largest value in it. */
double WhiteOf(const cv::Mat& channel, double largest)
{
  if (largest == 1 || (channel.depth() >= CV_32F && largest <= 1))
  {
    return 1;
  }
  return channel.depth() == CV_16U && largest > 255 ? 65535 : 255;
}
}

Image<std::uint8_t> ReadMaskFile(const std::filesystem::path& path)
{
  constexpr double threshold = 127; // above it is object
  const auto [channel, coloured] = ChannelOf(DecodePicture(path, cv::IMREAD_UNCHANGED));
  const auto [least, largest] = RangeOf(channel);
  const double white = WhiteOf(channel, largest);
  const double scale = 255 / white;
  if (largest != 0 && largest * scale <= threshold)
  {
    throw Error(path.string(), "is no mask: nothing in it is bright enough to be the object",
      "a largest value of " + NumberText(largest),
      NumberText(white) + " for the object, or masks of 0 and 1");
  }
  if (coloured && least * scale > threshold)
  {
    throw Error(path.string(), "is no mask: nothing in it is dark enough to be the background",
      "colours with values from " + NumberText(least) + " on", "black for the background");
  }
  cv::Mat mask;
  channel.convertTo(mask, CV_8U, scale);
  return FromMat<std::uint8_t>(mask);
}
}
