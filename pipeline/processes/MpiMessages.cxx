// SPDX-License-Identifier: GPL-3.0-or-later
#include "processes/MpiMessages.h"

#include "base/ByteStream.h"
#include "synthesis/DataBytes.h"

#include <cstdint>

namespace novelview
{
std::string Packed(const WorkResult& result)
{
  ByteWriter writer;
  writer.Add<std::uint64_t>(result.Numbers.size());
  for (const double number : result.Numbers)
  {
    writer.Add(number);
  }
  writer.Add<std::uint64_t>(result.Notes.size());
  for (const LogRecord& note : result.Notes)
  {
    writer.Add(note.Seconds);
    writer.AddText(note.Text);
  }
  writer.Add<std::uint64_t>(result.Images.size());
  for (vtkImageData* image : result.Images)
  {
    writer.AddText(PackedImage(image));
  }
  return std::move(writer.Written);
}

WorkResult Unpacked(std::string_view bytes)
{
  ByteReader reader(bytes, "message of another process");
  WorkResult result;
  for (auto count = reader.Take<std::uint64_t>(); count > 0; --count)
  {
    result.Numbers.push_back(reader.Take<double>());
  }
  for (auto count = reader.Take<std::uint64_t>(); count > 0; --count)
  {
    const auto seconds = reader.Take<double>();
    result.Notes.push_back({ reader.TakeText(), seconds });
  }
  for (auto count = reader.Take<std::uint64_t>(); count > 0; --count)
  {
    const std::string_view taken = reader.TakeBytes(reader.Take<std::uint64_t>());
    result.Images.push_back(UnpackedImage(taken, "picture from another process"));
  }
  return result;
}
}
