// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/VtpBytes.h"

#include "base/ByteStream.h"
#include "base/QuietCompressor.h"
#include "core/Error.h"
#include "core/PrintableText.h"

#include <vtkBase64Utilities.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <bit>
#include <lzma.h>

namespace novelview
{
static_assert(std::endian::native == std::endian::little);

namespace
{
constexpr const char* Lzma = "vtkLZMADataCompressor";

/** Not with VTK, whose class allows the data any amount of memory. */
bool UncompressLzma(std::string_view block, char* to, std::size_t size)
{
  std::uint64_t memory = 256u << 20;
  std::size_t from = 0;
  std::size_t written = 0;
  return lzma_stream_buffer_decode(&memory, 0, nullptr,
           reinterpret_cast<const std::uint8_t*>(block.data()), &from, block.size(),
           reinterpret_cast<std::uint8_t*>(to), &written, size) == LZMA_OK &&
    written == size;
}

/** Characters of base64 for this many bytes. */
std::size_t Base64Length(std::size_t bytes)
{
  return (bytes + 2) / 3 * 4;
}

/** The first bytes of an array. */
std::string FirstBytes(
  std::string_view source, bool base64, std::size_t count, const std::string& where)
{
  std::string bytes;
  const std::size_t most = base64 ? source.size() / 4 * 3 : source.size();
  std::size_t got = std::min(count, most);
  if (count <= most && base64)
  {
    bytes.resize(count);
    got = vtkBase64Utilities::DecodeSafely(reinterpret_cast<const unsigned char*>(source.data()),
      Base64Length(count), reinterpret_cast<unsigned char*>(bytes.data()), count);
  }
  if (got != count)
  {
    throw Error(where, "data of the array is malformed or too short",
      std::to_string(got) + " bytes", std::to_string(count) + " bytes");
  }
  return base64 ? bytes : std::string(source.substr(0, count));
}

/** What a block of a compressed array contains, in bytes; the header is that of ReadBlocks(). */
std::uint64_t LengthOf(const std::vector<std::uint64_t>& header, std::uint64_t block)
{
  const bool isPartial = block + 1 == header[0] && header[2] > 0;
  return header[isPartial ? 2 : 1];
}
}

std::string TextOf(const pugi::xml_node& element)
{
  std::string text;
  for (const pugi::xml_node& child : element.children())
  {
    if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
    {
      text += child.value();
    }
  }
  return text;
}

VtpBytes::VtpBytes(const VtpDocument& document)
  : Document(document)
  , Compressor(document.Root().attribute("compressor").value())
{
  const pugi::xml_node root = document.Root();
  const std::string_view order = root.attribute("byte_order").as_string("LittleEndian");
  if (order != "LittleEndian" && order != "BigEndian")
  {
    throw Error(
      document.Where(root), "unknown byte_order", Quoted(order), "LittleEndian or BigEndian");
  }
  this->Swap = order == "BigEndian";
  const std::string_view header = root.attribute("header_type").as_string("UInt32");
  if (header != "UInt32" && header != "UInt64")
  {
    throw Error(document.Where(root), "unknown header_type", Quoted(header), "UInt32 or UInt64");
  }
  this->HeaderSize = header == "UInt64" ? 8 : 4;
  if (!this->Compressor.empty() && this->Compressor != "vtkZLibDataCompressor" &&
    this->Compressor != "vtkLZ4DataCompressor" && this->Compressor != Lzma)
  {
    throw Error(document.Where(root), "unknown compressor", Quoted(this->Compressor),
      std::string("vtkZLibDataCompressor, vtkLZ4DataCompressor or ") + Lzma);
  }
}

std::string VtpBytes::Read(const pugi::xml_node& array, std::uint64_t size) const
{
  const std::string where = this->Document.Where(array);
  const std::string_view format = array.attribute("format").value();
  std::string text;
  std::string_view source;
  bool base64 = true;
  if (format == "appended")
  {
    const std::string_view appended = this->Document.Appended();
    const std::uint64_t offset = this->Document.Count(array, "offset", 0);
    if (offset > appended.size())
    {
      throw Error(where, "array begins behind the end of the file", std::to_string(offset),
        "an offset up to " + std::to_string(appended.size()));
    }
    source = appended.substr(offset);
    base64 = this->Document.IsAppendedBase64();
  }
  else if (format == "binary")
  {
    text = TextOf(array);
    std::erase_if(text, [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; });
    source = text;
  }
  else
  {
    throw Error(where, "array has an unknown format", Quoted(format), "ascii, binary or appended");
  }
  if (!this->Compressor.empty())
  {
    return this->ReadBlocks(array, source, base64, size);
  }
  const std::uint64_t length = this->ReadHeader(array, source, base64, 1)[0];
  if (length != size)
  {
    throw Error(where, "array has the wrong length", std::to_string(length) + " bytes",
      std::to_string(size) + " bytes");
  }
  return FirstBytes(source, base64, this->HeaderSize + size, where).substr(this->HeaderSize);
}

/**
 * Compressed arrays have a header: the number of blocks, their size before compression, that of the
 * last block if it is another (else 0), and the size of each after compression.
 */
std::string VtpBytes::ReadBlocks(
  const pugi::xml_node& array, std::string_view source, bool base64, std::uint64_t size) const
{
  const std::string where = this->Document.Where(array);
  const std::uint64_t blocks = this->ReadHeader(array, source, base64, 1)[0];
  if (blocks > source.size() / this->HeaderSize)
  {
    throw Error(where, "data of the array is too short for its blocks", std::to_string(blocks),
      std::to_string(source.size() / this->HeaderSize) + " at most");
  }
  const std::vector<std::uint64_t> header = this->ReadHeader(array, source, base64, 3 + blocks);
  // Header and blocks are two texts in base64.
  const std::size_t headerSize = header.size() * this->HeaderSize;
  source.remove_prefix(base64 ? Base64Length(headerSize) : headerSize);
  std::uint64_t compressed = 0;
  std::uint64_t whole = 0;
  for (std::uint64_t block = 0; block < blocks; ++block)
  {
    const std::uint64_t blockSize = header[3 + block];
    if (blockSize > source.size() - compressed)
    {
      throw Error(where, "data of the array is too short for its blocks");
    }
    if (LengthOf(header, block) > blockSize * MaxExpansion)
    {
      throw Error(where, "block of the array is too short for its contents");
    }
    compressed += blockSize;
    whole += LengthOf(header, block);
  }
  if (whole != size)
  {
    throw Error(where, "blocks of the array have the wrong length",
      std::to_string(whole) + " bytes", std::to_string(size) + " bytes");
  }
  const std::string data = FirstBytes(source, base64, compressed, where);
  std::string_view rest = data;
  std::string bytes(size, '\0');
  std::size_t written = 0;
  for (std::uint64_t block = 0; block < blocks; ++block)
  {
    const std::size_t length = LengthOf(header, block);
    this->Uncompress(array, rest.substr(0, header[3 + block]), bytes.data() + written, length);
    rest.remove_prefix(header[3 + block]);
    written += length;
  }
  return bytes;
}

/** The first numbers of the header of an array. */
std::vector<std::uint64_t> VtpBytes::ReadHeader(
  const pugi::xml_node& array, std::string_view source, bool base64, std::uint64_t count) const
{
  const std::string bytes =
    FirstBytes(source, base64, count * this->HeaderSize, this->Document.Where(array));
  std::vector<std::uint64_t> header(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const char* raw = bytes.data() + i * this->HeaderSize;
    header[i] = this->HeaderSize == 8 ? NumberFrom<std::uint64_t>(raw, this->Swap)
                                      : NumberFrom<std::uint32_t>(raw, this->Swap);
  }
  return header;
}

void VtpBytes::Uncompress(
  const pugi::xml_node& array, std::string_view block, char* to, std::size_t size) const
{
  bool good = false;
  if (this->Compressor == Lzma)
  {
    good = UncompressLzma(block, to, size);
  }
  else if (this->Compressor == "vtkLZ4DataCompressor")
  {
    good =
      QuietCompressor(vtkSmartPointer<vtkLZ4DataCompressor>::New()).Uncompress(block, to, size);
  }
  else
  {
    good =
      QuietCompressor(vtkSmartPointer<vtkZLibDataCompressor>::New()).Uncompress(block, to, size);
  }
  if (!good)
  {
    throw Error(this->Document.Where(array), "compressed data of the array is damaged");
  }
}
}
