// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/CheckedSilhouettes.h"

#include "base/Parallel.h"
#include "images/OpenCvPixels.h"
#include "silhouettes/ContourDistance.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace novelview
{
namespace
{
/** Part of the frame's border that is object. */
double BorderShare(const Image<std::uint8_t>& mask)
{
  int object = 0;
  for (int x = 0; x < mask.Width; ++x)
  {
    object += (mask(x, 0) > 127) + (mask(x, mask.Height - 1) > 127);
  }
  for (int y = 0; y < mask.Height; ++y)
  {
    object += (mask(0, y) > 127) + (mask(mask.Width - 1, y) > 127);
  }
  return object / (2.0 * (mask.Width + mask.Height));
}

bool HasContour(const Image<std::uint8_t>& mask)
{
  const auto object =
    std::count_if(mask.Values.begin(), mask.Values.end(), [](std::uint8_t v) { return v > 127; });
  return object > 0 && object < static_cast<std::ptrdiff_t>(mask.Values.size());
}
}

CheckedSilhouettes::CheckedSilhouettes(const std::vector<Photograph>& cameras,
  const std::vector<FoundMask>& masks, bool invert, int workingSize)
  : Size(workingSize)
  , All(cameras.size())
{
  ParallelForEach(cameras.size(),
    [&](std::size_t i) { this->All[i] = Reduce(cameras[i], masks[i], invert, workingSize); });
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    if (!this->All[i].Distance.Values.empty())
    {
      this->Used.push_back(static_cast<int>(i));
    }
  }
}

CheckedSilhouettes::Reduced CheckedSilhouettes::Reduce(
  const Photograph& camera, const FoundMask& found, bool invert, int workingSize)
{
  const Image<std::uint8_t>& mask = found.Pixels;
  Reduced reduced;
  if (!HasContour(mask))
  {
    return reduced;
  }
  reduced.Mask = mask;
  if (invert && found.Source != MaskSource::Extracted)
  {
    for (std::uint8_t& value : reduced.Mask.Values)
    {
      value = static_cast<std::uint8_t>(255 - value);
    }
  }
  if (!camera.Distortion.IsPinhole())
  {
    reduced.Mask = Undistorted(reduced.Mask.Ref(), camera.Distortion, camera.Cam.K);
  }
  reduced.BorderShare = BorderShare(reduced.Mask);
  const int longer = std::max(mask.Width, mask.Height);
  if (longer > workingSize)
  {
    // Whole pixels are averaged, so that the contour keeps its place to a fraction of a pixel.
    const int factor = (longer + workingSize - 1) / workingSize;
    const cv::Mat whole = ToMat(ImageRef<const std::uint8_t>(reduced.Mask.Ref()));
    const cv::Rect used(0, 0, whole.cols / factor * factor, whole.rows / factor * factor);
    cv::Mat small;
    cv::resize(whole(used), small, used.size() / factor, 0, 0, cv::INTER_AREA);
    reduced.Mask = FromMat<std::uint8_t>(small);
    reduced.Reduction = factor;
  }
  if (!HasContour(reduced.Mask))
  {
    return {};
  }
  reduced.Distance = SignedContourDistance(reduced.Mask.Ref());
  return reduced;
}

bool CheckedSilhouettes::Replace(
  int id, const Photograph& camera, const FoundMask& mask, bool invert)
{
  Reduced reduced = Reduce(camera, mask, invert, this->Size);
  if (reduced.Distance.Values.empty())
  {
    return false;
  }
  this->All[id] = std::move(reduced);
  return true;
}

std::vector<View> CheckedSilhouettes::ViewsOf(
  const std::vector<Photograph>& cameras, const std::vector<int>& ids) const
{
  std::vector<View> views;
  for (const int id : ids)
  {
    const Reduced& reduced = this->All[id];
    View view;
    view.Name = cameras[id].Name;
    view.Cam = cameras[id].Cam;
    view.Cam.Width = reduced.Mask.Width;
    view.Cam.Height = reduced.Mask.Height;
    // Pixel centres are integers: x + 0.5 is what scales.
    view.Cam.K.topRows<2>() /= reduced.Reduction;
    view.Cam.K.block<2, 1>(0, 2).array() += 0.5 / reduced.Reduction - 0.5;
    view.Mask = reduced.Mask.Ref();
    view.ContourDistance = reduced.Distance.Ref();
    views.push_back(view);
  }
  return views;
}
}
