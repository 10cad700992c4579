// SPDX-License-Identifier: GPL-3.0-or-later
#include "images/ExifOrientation.h"

#include "base/ByteStream.h"
#include "base/InputFile.h"

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace novelview
{
namespace
{
/** A number at a place of TIFF data; 0 behind the end. */
template <class T>
T NumberAt(std::string_view tiff, std::size_t at, bool swap)
{
  return at <= tiff.size() && sizeof(T) <= tiff.size() - at ? NumberFrom<T>(&tiff[at], swap) : T(0);
}

/** The tag in TIFF data: byte order, 42, place of the first directory, entries of 12 bytes. */
int OrientationIn(std::string_view tiff)
{
  constexpr std::uint16_t orientationTag = 0x0112;
  const bool little = tiff.starts_with("II");
  if (!little && !tiff.starts_with("MM"))
  {
    return 1;
  }
  const bool swap = little != (std::endian::native == std::endian::little);
  const std::size_t directory = NumberAt<std::uint32_t>(tiff, 4, swap);
  const int entries = NumberAt<std::uint16_t>(tiff, directory, swap);
  for (int entry = 0; entry < entries; ++entry)
  {
    const std::size_t at = directory + 2 + 12 * static_cast<std::size_t>(entry);
    if (NumberAt<std::uint16_t>(tiff, at, swap) == orientationTag)
    {
      const int orientation = NumberAt<std::uint16_t>(tiff, at + 8, swap);
      return orientation >= 1 && orientation <= 8 ? orientation : 1;
    }
  }
  return 1;
}
}

int ReadExifOrientation(const std::filesystem::path& file)
{
  constexpr std::size_t headBytes = 128 * 1024; // EXIF data stand in front, in at most 64 KiB
  const std::string head = ReadInputStart(file, headBytes);
  const bool jpeg = head.starts_with("\xff\xd8");
  if (!jpeg && !head.starts_with("\x89PNG"))
  {
    return 1;
  }
  const std::string_view mark = jpeg ? std::string_view("Exif\0\0", 6) : "eXIf";
  const std::size_t at = head.find(mark);
  return at == std::string::npos ? 1
                                 : OrientationIn(std::string_view(head).substr(at + mark.size()));
}
}
