// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/NumpyArrays.h"

#include "base/ByteStream.h"
#include "base/InputFile.h"
#include "core/Error.h"

#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
constexpr std::size_t MaxMemberBytes = 64 * 1024 * 1024;

/** What the header of an array says; its text is the literal of a Python dictionary. */
struct NpyHeader
{
  std::string Type; ///< "<f8"
  bool ColumnsFirst = false;
  std::vector<std::size_t> Shape;
};

/** The text between two marks behind a key; empty when it is not there. */
std::string_view Between(std::string_view text, std::string_view key, char open, char close)
{
  const std::size_t at = text.find(key);
  const std::size_t begin = at == std::string_view::npos ? at : text.find(open, at + key.size());
  const std::size_t end = begin == std::string_view::npos ? begin : text.find(close, begin + 1);
  return end == std::string_view::npos ? "" : text.substr(begin + 1, end - begin - 1);
}

NpyHeader ParseHeader(std::string_view text, const std::string& where)
{
  NpyHeader header;
  header.Type = Between(text, "'descr':", '\'', '\'');
  header.ColumnsFirst = text.find("'fortran_order': True") != std::string_view::npos;
  std::string_view shape = Between(text, "'shape':", '(', ')');
  while (!shape.empty())
  {
    std::size_t extent = 0;
    const auto [stop, failure] = std::from_chars(shape.data(), shape.data() + shape.size(), extent);
    if (failure != std::errc() || extent > MaxMemberBytes)
    {
      throw Error(where, "NumPy array has no shape", std::string(shape), "numbers");
    }
    header.Shape.push_back(extent);
    shape.remove_prefix(static_cast<std::size_t>(stop - shape.data()));
    shape.remove_prefix(std::min(shape.find_first_of("0123456789"), shape.size()));
  }
  return header;
}

template <class T>
std::vector<double> Numbers(std::string_view bytes)
{
  std::vector<double> values;
  for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T))
  {
    values.push_back(static_cast<double>(NumberFrom<T>(&bytes[at])));
  }
  return values;
}

/** The size of a value of a type, and how such are read; nothing when it is no number. */
struct ValueType
{
  const char* Name;
  std::size_t Bytes;
  std::vector<double> (*Read)(std::string_view bytes);
};

const ValueType* TypeOf(const std::string& name)
{
  static const ValueType types[] = { { "<f8", 8, Numbers<double> }, { "<f4", 4, Numbers<float> },
    { "<i8", 8, Numbers<std::int64_t> }, { "<i4", 4, Numbers<std::int32_t> },
    { "<u8", 8, Numbers<std::uint64_t> }, { "<u4", 4, Numbers<std::uint32_t> },
    { "<i2", 2, Numbers<std::int16_t> }, { "<u2", 2, Numbers<std::uint16_t> },
    { "|i1", 1, Numbers<std::int8_t> }, { "|u1", 1, Numbers<std::uint8_t> } };
  const auto found = std::find_if(std::begin(types), std::end(types),
    [&name](const ValueType& type) { return name == type.Name; });
  return found == std::end(types) ? nullptr : found;
}

/** Values whose first index runs fastest, in rows. */
std::vector<double> InRows(const std::vector<double>& values, const std::vector<std::size_t>& shape)
{
  std::vector<double> rows(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    std::size_t rest = i;
    std::size_t place = 0;
    std::size_t stride = 1;
    for (const std::size_t extent : shape)
    {
      stride *= extent;
    }
    for (const std::size_t extent : shape)
    {
      stride /= extent;
      place += rest % extent * stride;
      rest /= extent;
    }
    rows[place] = values[i];
  }
  return rows;
}

std::string Inflated(std::string_view bytes, std::size_t size, const std::string& where)
{
  std::string result(size, '\0');
  z_stream stream = {};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(size);
  const bool whole = inflateInit2(&stream, -MAX_WBITS) == Z_OK &&
    inflate(&stream, Z_FINISH) == Z_STREAM_END && stream.total_out == size;
  inflateEnd(&stream);
  if (!whole)
  {
    throw Error(where, "is damaged: its compressed bytes do not give what they should");
  }
  return result;
}

/** An entry of a zip file's directory. */
struct ZipEntry
{
  std::string Name;
  std::uint16_t Method = 0;
  std::uint32_t Checksum = 0;
  std::uint32_t Packed = 0;
  std::uint32_t Size = 0;
  std::uint32_t Place = 0; ///< of its own header
};

/** The directory, which stands at the end; each entry is 46 bytes, a name, and two more texts. */
std::vector<ZipEntry> ZipDirectory(const std::string& bytes, const std::string& where)
{
  const std::size_t end = bytes.rfind("PK\x05\x06");
  if (end == std::string::npos || bytes.size() - end < 22)
  {
    throw Error(where, "is no whole .npz file", std::to_string(bytes.size()) + " bytes",
      "a zip file with its directory");
  }
  const auto entries = NumberFrom<std::uint16_t>(&bytes[end + 10]);
  const auto begin = NumberFrom<std::uint32_t>(&bytes[end + 16]);
  ByteReader reader(std::string_view(bytes).substr(std::min<std::size_t>(begin, end)), where);
  std::vector<ZipEntry> directory;
  for (int i = 0; i < entries; ++i)
  {
    const std::string_view fixed = reader.TakeBytes(46);
    ZipEntry entry;
    entry.Method = NumberFrom<std::uint16_t>(&fixed[10]);
    entry.Checksum = NumberFrom<std::uint32_t>(&fixed[16]);
    entry.Packed = NumberFrom<std::uint32_t>(&fixed[20]);
    entry.Size = NumberFrom<std::uint32_t>(&fixed[24]);
    entry.Place = NumberFrom<std::uint32_t>(&fixed[42]);
    entry.Name = reader.TakeBytes(NumberFrom<std::uint16_t>(&fixed[28]));
    reader.TakeBytes(NumberFrom<std::uint16_t>(&fixed[30]));
    reader.TakeBytes(NumberFrom<std::uint16_t>(&fixed[32]));
    directory.push_back(entry);
  }
  return directory;
}

/** The bytes of a member, behind its own header of 30 bytes, a name and another text. */
std::string MemberBytes(const std::string& bytes, const ZipEntry& entry, const std::string& where)
{
  ByteReader reader(
    std::string_view(bytes).substr(std::min<std::size_t>(entry.Place, bytes.size())), where);
  const std::string_view fixed = reader.TakeBytes(30);
  reader.TakeBytes(NumberFrom<std::uint16_t>(&fixed[26]));
  reader.TakeBytes(NumberFrom<std::uint16_t>(&fixed[28]));
  if (entry.Size > MaxMemberBytes || (entry.Method != 0 && entry.Method != Z_DEFLATED))
  {
    throw Error(where, "cannot be read",
      std::to_string(entry.Size) + " bytes of compression " + std::to_string(entry.Method),
      "at most 64 MiB, stored or deflated");
  }
  const std::string_view packed = reader.TakeBytes(entry.Packed);
  std::string member =
    entry.Method == 0 ? std::string(packed) : Inflated(packed, entry.Size, where);
  if (crc32(0, reinterpret_cast<const Bytef*>(member.data()), static_cast<uInt>(member.size())) !=
    entry.Checksum)
  {
    throw Error(where, "is damaged: its checksum is another one");
  }
  return member;
}

/** An array's bytes: the header ends with a line break at a multiple of 64 bytes. */
std::string ComposeNpy(const NumpyArray& array)
{
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (";
  for (const std::size_t extent : array.Shape)
  {
    header += std::to_string(extent) + ", ";
  }
  header += "), }";
  constexpr std::size_t before = 10; // bytes in front of the header
  header.append(63 - (before + header.size()) % 64, ' ');
  header += '\n';
  ByteWriter bytes;
  bytes.Written = std::string("\x93NUMPY\1\0", 8);
  bytes.Add(static_cast<std::uint16_t>(header.size()));
  bytes.Written += header;
  bytes.AddBytes(array.Values.data(), array.Values.size() * sizeof(double));
  return bytes.Written;
}

/** The array, or nothing when it holds other things than numbers. */
std::optional<NumpyArray> ParseNumbers(std::string_view bytes, const std::string& where)
{
  ByteReader reader(bytes, where);
  const std::string_view fixed = reader.TakeBytes(8);
  if (!fixed.starts_with("\x93NUMPY"))
  {
    throw Error(where, "is no NumPy array");
  }
  const std::size_t length =
    fixed[6] == 1 ? reader.Take<std::uint16_t>() : reader.Take<std::uint32_t>();
  const NpyHeader header = ParseHeader(reader.TakeBytes(length), where);
  const ValueType* const type = TypeOf(header.Type);
  if (!type)
  {
    return std::nullopt;
  }
  std::size_t count = 1;
  for (const std::size_t extent : header.Shape)
  {
    count = std::min(count * extent, MaxMemberBytes);
  }
  NumpyArray array{ header.Shape, type->Read(reader.TakeBytes(count * type->Bytes)) };
  if (header.ColumnsFirst)
  {
    array.Values = InRows(array.Values, array.Shape);
  }
  return array;
}
}

NumpyArray ParseNpy(std::string_view bytes, const std::string& where)
{
  if (std::optional<NumpyArray> array = ParseNumbers(bytes, where))
  {
    return *std::move(array);
  }
  throw Error(where, "NumPy array holds no numbers");
}

std::map<std::string, NumpyArray> ReadNpz(const fs::path& file)
{
  const std::string bytes = ReadInputFile(file);
  std::map<std::string, NumpyArray> arrays;
  for (const ZipEntry& entry : ZipDirectory(bytes, file.string()))
  {
    const std::string where = file.string() + ", " + entry.Name;
    const fs::path name(entry.Name);
    if (auto array = ParseNumbers(MemberBytes(bytes, entry, where), where))
    {
      arrays.emplace(name.extension() == ".npy" ? name.stem().string() : entry.Name, *array);
    }
  }
  return arrays;
}

std::string ComposeNpz(const std::map<std::string, NumpyArray>& arrays)
{
  ByteWriter file;
  ByteWriter directory;
  for (const auto& [name, array] : arrays)
  {
    const std::string member = ComposeNpy(array);
    const std::string memberName = name + ".npy";
    const auto place = static_cast<std::uint32_t>(file.Written.size());
    const auto checksum = static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(member.data()), static_cast<uInt>(member.size())));
    // Version 2.0, no flags, stored, 1980-01-01, checksum, both sizes, length of the name, no more.
    ByteWriter common;
    for (const std::uint16_t number : { 20, 0, 0, 0, 33 })
    {
      common.Add(number);
    }
    common.Add(checksum);
    common.Add(static_cast<std::uint32_t>(member.size()));
    common.Add(static_cast<std::uint32_t>(member.size()));
    common.Add(static_cast<std::uint16_t>(memberName.size()));
    common.Add(std::uint16_t(0));
    file.Written += "PK\x03\x04" + common.Written + memberName + member;
    directory.Written += "PK\x01\x02" + std::string("\x14\0", 2) + common.Written;
    directory.Written.append(10, '\0'); // comment, disk, attributes
    directory.Add(place);
    directory.Written += memberName;
  }
  const auto place = static_cast<std::uint32_t>(file.Written.size());
  file.Written += directory.Written + std::string("PK\x05\x06\0\0\0\0", 8);
  file.Add(static_cast<std::uint16_t>(arrays.size()));
  file.Add(static_cast<std::uint16_t>(arrays.size()));
  file.Add(static_cast<std::uint32_t>(directory.Written.size()));
  file.Add(place);
  file.Add(std::uint16_t(0));
  return file.Written;
}
}
