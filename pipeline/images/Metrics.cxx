// SPDX-License-Identifier: GPL-3.0-or-later
#include "images/Metrics.h"

#include "ViewAccess.h"
#include "core/Error.h"
#include "images/OpenCvPixels.h"

#include <opencv2/imgproc.hpp>

#include <vtkImageData.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace novelview
{
namespace
{
constexpr int WindowPx = 11;
constexpr double WindowSigmaPx = 1.5;

void CheckSizes(const MaskedPicture& rendered, const MaskedPicture& truth)
{
  const int width = truth.Color.Width;
  const int height = truth.Color.Height;
  const std::pair<const char*, const ImageRef<const std::uint8_t>*> others[] = {
    { "mask of the true picture", &truth.Mask }, { "rendered picture", &rendered.Color },
    { "mask of the rendered picture", &rendered.Mask }
  };
  for (const auto& [name, image] : others)
  {
    if (image->Width != width || image->Height != height)
    {
      throw Error(name, "size is not the true picture's", SizeText(image->Width, image->Height),
        SizeText(width, height));
    }
  }
  if (std::min(width, height) < WindowPx)
  {
    throw Error("metrics", "pictures are smaller than the window of the similarity",
      SizeText(width, height), "at least " + SizeText(WindowPx, WindowPx));
  }
}

cv::Mat MaskOf(const MaskedPicture& picture)
{
  return ToMat(picture.Mask) > 127;
}

/** The image, black outside its own mask. */
cv::Mat Blackened(const MaskedPicture& picture, const cv::Mat& mask)
{
  cv::Mat color = ToMat(picture.Color);
  color.setTo(cv::Scalar::all(0), mask == 0);
  return color;
}

cv::Mat Smooth(const cv::Mat& image)
{
  const cv::Mat window = cv::getGaussianKernel(WindowPx, WindowSigmaPx, CV_64F);
  cv::Mat result;
  cv::sepFilter2D(image, result, CV_64F, window, window, cv::Point(-1, -1), 0, cv::BORDER_REFLECT);
  return result;
}

/** The map of structural similarity of two grey images of 8 bits. */
cv::Mat SimilarityMap(const cv::Mat& greyA, const cv::Mat& greyB)
{
  const double c1 = 0.01 * 255 * 0.01 * 255;
  const double c2 = 0.03 * 255 * 0.03 * 255;
  cv::Mat a;
  cv::Mat b;
  greyA.convertTo(a, CV_64F);
  greyB.convertTo(b, CV_64F);
  const cv::Mat meanA = Smooth(a);
  const cv::Mat meanB = Smooth(b);
  const cv::Mat meanAA = meanA.mul(meanA);
  const cv::Mat meanBB = meanB.mul(meanB);
  const cv::Mat meanAB = meanA.mul(meanB);
  const cv::Mat varianceA = Smooth(a.mul(a)) - meanAA;
  const cv::Mat varianceB = Smooth(b.mul(b)) - meanBB;
  const cv::Mat covariance = Smooth(a.mul(b)) - meanAB;
  const cv::Mat above = (2 * meanAB + c1).mul(2 * covariance + c2);
  const cv::Mat below = (meanAA + meanBB + c1).mul(varianceA + varianceB + c2);
  cv::Mat result;
  cv::divide(above, below, result);
  return result;
}

cv::Mat Luma(const cv::Mat& rgb)
{
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  return grey;
}

/** Mean over the three channels of the squared difference, per pixel. */
cv::Mat SquaredDifference(const cv::Mat& a, const cv::Mat& b)
{
  cv::Mat squared(a.size(), CV_64F);
  for (int y = 0; y < a.rows; ++y)
  {
    for (int x = 0; x < a.cols; ++x)
    {
      const cv::Vec3d difference =
        cv::Vec3d(a.at<cv::Vec3b>(y, x)) - cv::Vec3d(b.at<cv::Vec3b>(y, x));
      squared.at<double>(y, x) = difference.dot(difference) / 3;
    }
  }
  return squared;
}
}

MaskedPicture MaskedPictureOf(vtkImageData* image, const char* where)
{
  return { TopDownArray<const unsigned char>(image, arrays::Color, 3, where, true),
    TopDownArray<const unsigned char>(image, arrays::Mask, 1, where, true) };
}

Scores Compare(const MaskedPicture& rendered, const MaskedPicture& truth)
{
  CheckSizes(rendered, truth);
  const cv::Mat renderedMask = MaskOf(rendered);
  const cv::Mat trueMask = MaskOf(truth);
  const double truePixels = cv::countNonZero(trueMask);
  if (truePixels == 0)
  {
    throw Error("mask of the true picture", "is empty");
  }
  const cv::Mat foreground = renderedMask | trueMask;
  const cv::Mat a = Blackened(rendered, renderedMask);
  const cv::Mat b = Blackened(truth, trueMask);
  Scores scores;
  scores.Rms = std::sqrt(cv::mean(SquaredDifference(a, b), foreground)[0]);
  scores.Psnr = 20 * std::log10(255 / std::max(scores.Rms, 1e-9));
  scores.Ssim = cv::mean(SimilarityMap(Luma(a), Luma(b)), foreground)[0];
  const double common = cv::countNonZero(renderedMask & trueMask);
  scores.Iou = common / cv::countNonZero(foreground);
  scores.Missing = (truePixels - common) / truePixels;
  scores.Excess = (cv::countNonZero(renderedMask) - common) / truePixels;
  return scores;
}

double MaskIou(const Image<std::uint8_t>& a, const Image<std::uint8_t>& b)
{
  if (a.Width != b.Width || a.Height != b.Height)
  {
    return 0;
  }
  double both = 0;
  double either = 0;
  for (std::size_t i = 0; i < a.Values.size(); ++i)
  {
    both += a.Values[i] > 127 && b.Values[i] > 127;
    either += a.Values[i] > 127 || b.Values[i] > 127;
  }
  return either > 0 ? both / either : 0;
}

Image<float> ErrorMap(const MaskedPicture& rendered, const MaskedPicture& truth)
{
  CheckSizes(rendered, truth);
  const cv::Mat squared =
    SquaredDifference(Blackened(rendered, MaskOf(rendered)), Blackened(truth, MaskOf(truth)));
  cv::Mat error;
  cv::sqrt(squared, error);
  error.convertTo(error, CV_32F);
  return FromMat<float>(error);
}
}
