// SPDX-License-Identifier: GPL-3.0-or-later
#include "masks/MaskSheet.h"

#include "base/NumberText.h"
#include "images/OpenCvPixels.h"
#include "masks/Coverage.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
constexpr int CellWidth = 320; ///< px
constexpr int CellHeight = 240;
constexpr int LabelHeight = 22;
constexpr int SheetGap = 8;
const cv::Scalar Ground(32, 35, 40);
const cv::Scalar Ink(230, 232, 237);
const cv::Scalar OutlineInk(255, 0, 200); ///< a colour few objects have

/** The end of a name that fits under an image. */
std::string Fitting(const std::string& name)
{
  constexpr std::size_t Max = 26;
  return name.size() <= Max ? name : ".." + name.substr(name.size() - Max + 2);
}
}

MaskThumbnail MakeMaskThumbnail(const std::string& name, const ImageRef<const std::uint8_t>& photo,
  const ImageRef<const std::uint8_t>& mask)
{
  MaskThumbnail thumbnail{ name, MeasureCoverage(mask).Fraction, {} };
  const cv::Size cell(CellWidth, CellHeight);
  cv::Mat picture = Shrunk(ToMat(photo), cell);
  const cv::Mat object = Shrunk(ToMat(mask), cell) > 127;
  cv::Mat dark = picture * 0.4;
  dark.copyTo(picture, object == 0);
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(object.clone(), outlines, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  cv::drawContours(picture, outlines, -1, OutlineInk, 1);
  thumbnail.Picture = FromMat<std::uint8_t>(picture);
  return thumbnail;
}

Image<std::uint8_t> MaskContactSheet(const std::vector<MaskThumbnail>& thumbnails)
{
  const int count = std::max<int>(1, static_cast<int>(thumbnails.size()));
  const int columns = std::clamp(static_cast<int>(std::ceil(std::sqrt(count))), 1, 8);
  const int rows = (count + columns - 1) / columns;
  const int stepX = CellWidth + SheetGap;
  const int stepY = CellHeight + LabelHeight + SheetGap;
  cv::Mat sheet(rows * stepY + SheetGap, columns * stepX + SheetGap, CV_8UC3, Ground);
  for (std::size_t i = 0; i < thumbnails.size(); ++i)
  {
    const cv::Mat picture = ToMat(ImageRef<const std::uint8_t>(thumbnails[i].Picture.Ref()));
    const int x = SheetGap + static_cast<int>(i) % columns * stepX;
    const int y = SheetGap + static_cast<int>(i) / columns * stepY;
    const cv::Rect place(x + (CellWidth - picture.cols) / 2, y + (CellHeight - picture.rows) / 2,
      picture.cols, picture.rows);
    picture.copyTo(sheet(place));
    cv::putText(sheet,
      Fitting(thumbnails[i].Name) + Formatted("  %.1f %%", 100 * thumbnails[i].Coverage),
      cv::Point(x, y + CellHeight + LabelHeight - 6), cv::FONT_HERSHEY_SIMPLEX, 0.45, Ink, 1,
      cv::LINE_AA);
  }
  return FromMat<std::uint8_t>(sheet);
}
}
