// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/VideoContainer.h"

#include <cstdint>
#include <fstream>
#include <string>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/** Reads numbers at places of a file; what is beyond the end reads as zero. */
class Bytes
{
public:
  explicit Bytes(const fs::path& path)
    : File(path, std::ios::binary)
  {
    std::error_code failure;
    const std::uintmax_t size = fs::file_size(path, failure);
    this->Size = failure ? 0 : size;
  }
  std::string Text(std::uint64_t at, std::size_t count)
  {
    std::string text(count, '\0');
    this->File.clear();
    this->File.seekg(static_cast<std::streamoff>(at));
    this->File.read(text.data(), static_cast<std::streamsize>(count));
    return text;
  }
  /** Most significant byte first. */
  std::uint64_t Number(std::uint64_t at, std::size_t count)
  {
    std::uint64_t number = 0;
    for (const char byte : this->Text(at, count))
    {
      number = number << 8 | static_cast<unsigned char>(byte);
    }
    return number;
  }
  std::uint32_t LittleNumber(std::uint64_t at)
  {
    std::uint32_t number = 0;
    int shift = 0;
    for (const char byte : this->Text(at, 4))
    {
      number |= static_cast<std::uint32_t>(static_cast<unsigned char>(byte)) << shift;
      shift += 8;
    }
    return number;
  }

  std::uint64_t Size = 0;

private:
  std::ifstream File;
};

/** Chunks named RIFF, one after the other. */
bool IsWholeRiff(Bytes& bytes)
{
  constexpr std::uint64_t head = 8;
  std::uint64_t at = 0;
  while (at < bytes.Size && bytes.Text(at, 4) == "RIFF")
  {
    at += head + bytes.LittleNumber(at + 4);
  }
  return at == bytes.Size;
}

/** Boxes: a size that counts itself (0: up to the end, 1: it follows in 64 bits), and a name. */
bool IsWholeIsoMedia(Bytes& bytes)
{
  constexpr std::uint64_t head = 8;
  bool hasIndex = false;
  std::uint64_t at = 0;
  while (at < bytes.Size)
  {
    std::uint64_t size = bytes.Number(at, 4);
    hasIndex |= bytes.Text(at + 4, 4) == "moov";
    size = size == 1 ? bytes.Number(at + head, 8) : size;
    size = size == 0 ? bytes.Size - at : size;
    if (size < head || size > bytes.Size - at)
    {
      return false;
    }
    at += size;
  }
  return hasIndex;
}

/** Elements: a name, and a size whose leading zeros give its length. */
bool IsWholeMatroska(Bytes& bytes)
{
  std::uint64_t at = 0;
  while (at < bytes.Size)
  {
    at += 4; // names at this level have four bytes
    const auto first = static_cast<unsigned>(bytes.Number(at, 1));
    std::size_t length = 1;
    while (length < 9 && !(first & (0x100U >> length)))
    {
      ++length;
    }
    if (length == 9)
    {
      return false;
    }
    const std::uint64_t mask = (std::uint64_t(1) << (7 * length)) - 1;
    const std::uint64_t size = bytes.Number(at, length) & mask;
    if (size == mask || size > bytes.Size) // all ones: not known, so the file was never ended
    {
      return false;
    }
    at += length + size;
  }
  return at == bytes.Size;
}
}

bool IsWholeVideo(const fs::path& file)
{
  Bytes bytes(file);
  if (bytes.Text(0, 4) == "RIFF")
  {
    return IsWholeRiff(bytes);
  }
  if (bytes.Text(0, 4) == "\x1a\x45\xdf\xa3")
  {
    return IsWholeMatroska(bytes);
  }
  return bytes.Text(4, 4) == "ftyp" && IsWholeIsoMedia(bytes);
}
}
