// SPDX-License-Identifier: GPL-3.0-or-later
#include "PngFile.h"

#include "AtomicFile.h"
#include "ViewAccess.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace novelview
{
void WritePng(const std::filesystem::path& path, const ImageRef<const std::uint8_t>& image)
{
  cv::Mat pixels(image.Height, image.Width, CV_8UC(image.Channels));
  for (int y = 0; y < image.Height; ++y)
  {
    std::copy_n(image.Row(y), image.Width * image.Channels, pixels.ptr<std::uint8_t>(y));
  }
  if (image.Channels == 3)
  {
    cv::cvtColor(pixels, pixels, cv::COLOR_RGB2BGR);
  }
  WriteAtomically(path,
    [&pixels](const std::filesystem::path& temporary)
    {
      try
      {
        return cv::imwrite(temporary.string(), pixels);
      }
      catch (const cv::Exception&)
      {
        return false; // the caller's message names the file, OpenCV's its own source code
      }
    });
}

void WritePng(const std::filesystem::path& path, vtkImageData* image)
{
  WritePng(path, TopDownArray<const std::uint8_t>(image, arrays::Color, 3, path.string(), true));
}
}
