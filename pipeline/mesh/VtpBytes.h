// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_VtpBytes_h
#define novelview_VtpBytes_h

#include "mesh/VtpDocument.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace novelview
{
/** No compressor makes more of a byte: zlib's limit, the largest that arrays of numbers come near. */
constexpr std::uint64_t MaxExpansion = 1100;

/** All text of an element, without that of elements in it. */
std::string TextOf(const pugi::xml_node& element);

/** Reads the bytes of a VTP file's arrays: in base64 or raw, whole or in compressed blocks. */
class VtpBytes
{
public:
  /** The document must outlive the object. Throws Error when the file's attributes are unknown. */
  explicit VtpBytes(const VtpDocument& document);

  /** The `size` bytes of an array that is not a text. Throws Error when they are not as many. */
  std::string Read(const pugi::xml_node& array, std::uint64_t size) const;

  /** Whether the arrays' numbers are big-endian. */
  bool AreSwapped() const { return this->Swap; }

private:
  std::string ReadBlocks(
    const pugi::xml_node& array, std::string_view source, bool base64, std::uint64_t size) const;
  std::vector<std::uint64_t> ReadHeader(
    const pugi::xml_node& array, std::string_view source, bool base64, std::uint64_t count) const;
  void Uncompress(
    const pugi::xml_node& array, std::string_view block, char* to, std::size_t size) const;

  const VtpDocument& Document;
  std::string Compressor;     ///< "" = none
  std::size_t HeaderSize = 4; ///< bytes of a number in the headers of arrays
  bool Swap = false;          ///< numbers are big-endian
};
}

#endif
