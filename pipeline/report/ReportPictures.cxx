// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/ReportPictures.h"

#include "ViewAccess.h"
#include "base/Parallel.h"
#include "images/ImageFile.h"
#include "images/OpenCvPixels.h"

#include <opencv2/imgproc.hpp>

namespace novelview
{
namespace
{
/** Photographs of many data sets together must not make a page that no browser likes to open. */
constexpr std::size_t ManyPhotographs = 60;

cv::Mat ColorOf(vtkImageData* image, const std::string& where)
{
  return ToMat(TopDownArray<const std::uint8_t>(image, arrays::Color, 3, where, true));
}

cv::Mat MaskOf(vtkImageData* image, const std::string& where)
{
  return ToMat(TopDownArray<const std::uint8_t>(image, arrays::Mask, 1, where, true));
}

ReportPicture WithContour(vtkImageData* image, const std::string& name, int longestSidePx)
{
  const cv::Size within(longestSidePx, longestSidePx);
  cv::Mat color = Shrunk(ColorOf(image, name), within);
  const cv::Mat mask = Shrunk(MaskOf(image, name), within) > 127;
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  cv::drawContours(color, contours, -1, cv::Scalar(255, 194, 46), 1, cv::LINE_AA);
  const Image<std::uint8_t> pixels = FromMat<std::uint8_t>(color);
  return EmbedPicture(name, name, pixels.Ref(), longestSidePx);
}
}

std::vector<ReportPicture> PhotographPictures(vtkMultiBlockDataSet* views)
{
  const std::size_t count = views->GetNumberOfBlocks();
  const int longest = count > ManyPhotographs ? 160 : 320;
  std::vector<ReportPicture> pictures(count);
  ParallelForEach(count,
    [&](std::size_t i)
    {
      const auto viewId = static_cast<unsigned int>(i);
      pictures[i] = WithContour(ViewImage(views, viewId), ViewName(views, viewId), longest);
    });
  return pictures;
}

std::vector<vtkSmartPointer<vtkImageData>> SmallPhotographs(
  vtkMultiBlockDataSet* views, int longestSidePx)
{
  std::vector<vtkSmartPointer<vtkImageData>> images;
  for (unsigned int viewId = 0; viewId < views->GetNumberOfBlocks(); ++viewId)
  {
    const Image<std::uint8_t> small =
      FromMat<std::uint8_t>(Shrunk(ColorOf(ViewImage(views, viewId), ViewName(views, viewId)),
        { longestSidePx, longestSidePx }));
    auto image = NewImage(small.Width, small.Height);
    SetPixels(image, arrays::Color, small.Ref());
    images.push_back(image);
  }
  return images;
}

ReportPicture EmbedImage(const std::string& name, const std::string& caption, vtkImageData* image,
  int longestSidePx, bool blackened)
{
  cv::Mat color = ColorOf(image, name);
  if (blackened)
  {
    color.setTo(cv::Scalar::all(0), MaskOf(image, name) <= 127);
  }
  const Image<std::uint8_t> pixels = FromMat<std::uint8_t>(color);
  return EmbedPicture(name, caption, pixels.Ref(), longestSidePx);
}
}
