// SPDX-License-Identifier: GPL-3.0-or-later
#include "PngFile.h"

#include "AtomicFile.h"
#include "OpenCvPixels.h"
#include "ViewAccess.h"

#include <opencv2/imgcodecs.hpp>

namespace novelview
{
void WritePng(const std::filesystem::path& path, const ImageRef<const std::uint8_t>& image)
{
  const cv::Mat pixels = ToBgr(image);
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
