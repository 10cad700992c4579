// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/CheckedPhotograph.h"

#include "core/Error.h"
#include "core/Quantile.h"
#include "images/ImageFile.h"
#include "images/OpenCvPixels.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
cv::Mat LumaOf(const ImageRef<const std::uint8_t>& color)
{
  cv::Mat luma;
  cv::cvtColor(ToMat(color), luma, cv::COLOR_RGB2GRAY);
  return luma;
}

/** The mask as the stages would see it, without undistortion. */
Image<std::uint8_t> Upright(const FoundMask& found, bool invert)
{
  Image<std::uint8_t> mask = found.Pixels;
  if (invert && found.Source != MaskSource::Extracted)
  {
    for (std::uint8_t& value : mask.Values)
    {
      value = static_cast<std::uint8_t>(255 - value);
    }
  }
  return mask;
}

/** Brightness and clipping of the object. */
void MeasureExposure(
  const Image<std::uint8_t>& color, const Image<std::uint8_t>& mask, CheckedPhotograph& checked)
{
  constexpr int WhiteLevel = 253; // JPEG and resampling take the last levels from what is clipped
  const cv::Mat luma = LumaOf(color.Ref());
  std::vector<double> values;
  double clipped = 0;
  for (int y = 0; y < mask.Height; ++y)
  {
    for (int x = 0; x < mask.Width; ++x)
    {
      if (mask(x, y) > 127)
      {
        values.push_back(luma.at<std::uint8_t>(y, x));
        clipped += std::max({ color(x, y, 0), color(x, y, 1), color(x, y, 2) }) >= WhiteLevel;
      }
    }
  }
  if (!values.empty())
  {
    checked.Clipped = clipped / static_cast<double>(values.size());
    checked.Brightness = Quantile(std::move(values), 0.5);
  }
}

void CheckSizes(const Photograph& photograph, CheckedPhotograph& checked)
{
  const Camera& camera = photograph.Cam;
  if (camera.Width > 0 && (camera.Width != checked.Width || camera.Height != checked.Height))
  {
    checked.Problems.push_back("photograph is " + SizeText(checked.Width, checked.Height) +
      ", its calibration is for " + SizeText(camera.Width, camera.Height));
  }
  Image<std::uint8_t>& mask = checked.Mask.Pixels;
  if (!mask.Values.empty() && (mask.Width != checked.Width || mask.Height != checked.Height))
  {
    checked.Problems.push_back("mask is " + SizeText(mask.Width, mask.Height) +
      ", the photograph is " + SizeText(checked.Width, checked.Height));
    mask = {};
  }
}
}

double MeasureSharpness(
  const ImageRef<const std::uint8_t>& color, const ImageRef<const std::uint8_t>& mask)
{
  cv::Mat luma;
  LumaOf(color).convertTo(luma, CV_32F);
  cv::Mat fine;
  cv::Mat coarse;
  cv::GaussianBlur(luma, fine, cv::Size(), 1);
  cv::GaussianBlur(luma, coarse, cv::Size(), 3);
  cv::Mat where;
  cv::dilate(
    ToMat(mask) > 127, where, cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(7, 7)));
  const double finest = cv::mean(cv::abs(luma - fine), where)[0];
  const double coarser = cv::mean(cv::abs(fine - coarse), where)[0];
  return coarser > 0 ? finest / coarser : 0;
}

CheckedPhotograph InspectPhotograph(
  const Photograph& photograph, bool forceSilhouette, const SilhouetteOptions& silhouette)
{
  CheckedPhotograph checked;
  checked.Name = photograph.Name;
  try
  {
    const Image<std::uint8_t> color =
      ReadColorFile(photograph.File, photograph.Reading, &checked.Warnings);
    checked.Width = color.Width;
    checked.Height = color.Height;
    if (!forceSilhouette)
    {
      Photograph asItIs = photograph;
      asItIs.InvertMask = false;
      checked.Mask.Pixels = ReadGivenMask(asItIs);
      checked.Mask.Source = photograph.Mask.empty() ? MaskSource::Alpha : MaskSource::File;
    }
    if (checked.Mask.Pixels.Values.empty())
    {
      checked.Mask = { ExtractSilhouette(color.Ref(), silhouette), MaskSource::Extracted };
    }
    CheckSizes(photograph, checked);
    if (!checked.Mask.Pixels.Values.empty())
    {
      const Image<std::uint8_t> mask = Upright(checked.Mask, photograph.InvertMask);
      checked.Covered = MeasureCoverage(mask.Ref());
      checked.Sharpness = MeasureSharpness(color.Ref(), mask.Ref());
      MeasureExposure(color, mask, checked);
    }
  }
  catch (const Error& error)
  {
    checked.Problems.push_back(error.what());
  }
  return checked;
}

std::vector<std::size_t> FindOutliers(
  const std::vector<double>& values, double factor, const OutlierSides& sides)
{
  std::vector<double> logs;
  for (const double value : values)
  {
    if (value > 0)
    {
      logs.push_back(std::log(value));
    }
  }
  const double median = Quantile(logs, 0.5);
  for (double& each : logs)
  {
    each = std::abs(each - median);
  }
  // 1.48 median deviations are a standard deviation.
  const double limit = std::max(std::log(factor), 4 * 1.48 * Quantile(logs, 0.5));
  std::vector<std::size_t> outliers;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double off = values[i] > 0 ? std::log(values[i]) - median : 0;
    if ((sides.Below && off < -limit) || (sides.Above && off > limit))
    {
      outliers.push_back(i);
    }
  }
  return outliers;
}
}
