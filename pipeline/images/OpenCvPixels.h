// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the pipeline's sources: pixels as OpenCV sees them.
#ifndef novelview_OpenCvPixels_h
#define novelview_OpenCvPixels_h

#include "core/ImageRef.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cstdint>

namespace novelview
{
/** A copy as a cv::Mat, which cannot borrow: its stride is unsigned. Channels keep their order. */
template <class T>
cv::Mat ToMat(const ImageRef<const T>& pixels)
{
  cv::Mat mat(pixels.Height, pixels.Width, CV_MAKETYPE(cv::DataType<T>::depth, pixels.Channels));
  for (int y = 0; y < pixels.Height; ++y)
  {
    const T* row = pixels.Row(y);
    std::copy(row, row + static_cast<std::ptrdiff_t>(pixels.Width) * pixels.Channels,
      mat.template ptr<T>(y));
  }
  return mat;
}

/** A copy of a cv::Mat; channels keep their order. */
template <class T>
Image<T> FromMat(const cv::Mat& mat)
{
  CV_Assert(mat.depth() == cv::DataType<T>::depth);
  Image<T> image(mat.cols, mat.rows, mat.channels());
  const std::ptrdiff_t length = static_cast<std::ptrdiff_t>(mat.cols) * mat.channels();
  for (int y = 0; y < mat.rows; ++y)
  {
    const T* row = mat.template ptr<T>(y);
    std::copy(row, row + length, image.Values.data() + y * length);
  }
  return image;
}

/** A copy with the channels in OpenCV's order: BGR where there are three. */
cv::Mat ToBgr(const ImageRef<const std::uint8_t>& pixels);

/** A copy that is made smaller to fit into a size, its sides' ratio kept; never made larger. */
cv::Mat Shrunk(const cv::Mat& mat, const cv::Size& within);

/** 255 in the largest 8-connected component of what is not zero, 0 elsewhere. */
cv::Mat LargestComponent(const cv::Mat& mask);
}

#endif
