// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/InputFile.h"
#include "images/DecodedPicture.h"
#include "images/ImageFile.h"

#include <opencv2/imgcodecs.hpp>

#include <optional>
#include <string>

namespace novelview
{
namespace
{
/** A big-endian number of so many bytes. */
int NumberAt(const std::string& bytes, std::size_t at, int count)
{
  int number = 0;
  for (int i = 0; i < count; ++i)
  {
    number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  }
  return number;
}

/** A PNG file: 8 bytes of signature, the length and name of the first chunk, then the size. */
std::optional<PictureSize> SizeOfPng(const std::string& head)
{
  if (head.size() < 24 || !head.starts_with("\x89PNG\r\n"))
  {
    return {};
  }
  return PictureSize{ NumberAt(head, 16, 4), NumberAt(head, 20, 4) };
}

/** A JPEG file: segments of marker and length, up to that of the frame, which has the size. */
std::optional<PictureSize> SizeOfJpeg(const std::string& head)
{
  if (!head.starts_with("\xff\xd8"))
  {
    return {};
  }
  for (std::size_t at = 2; at + 9 <= head.size() && head[at] == '\xff';)
  {
    const int marker = NumberAt(head, at + 1, 1);
    const bool frame =
      marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (frame)
    {
      return PictureSize{ NumberAt(head, at + 7, 2), NumberAt(head, at + 5, 2) };
    }
    at += 2 + static_cast<std::size_t>(NumberAt(head, at + 2, 2));
  }
  return {};
}
}

PictureSize ReadPictureSize(const std::filesystem::path& path)
{
  constexpr std::size_t headBytes = 256 * 1024; // of photographs with EXIF data and a preview
  const std::string head = ReadInputStart(path, headBytes);
  if (const auto size = SizeOfPng(head))
  {
    return *size;
  }
  if (const auto size = SizeOfJpeg(head); size && size->Width > 0 && size->Height > 0)
  {
    return *size;
  }
  const cv::Mat mat = DecodePicture(path, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
  return { mat.cols, mat.rows };
}
}
