// SPDX-License-Identifier: GPL-3.0-or-later
#include "processes/MpiMessages.h"

#include "base/ByteStream.h"

#include <vtkCharArray.h>
#include <vtkCommunicator.h>
#include <vtkImageData.h>
#include <vtkNew.h>

#include <cstdint>
#include <cstring>

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
    vtkNew<vtkCharArray> marshalled;
    vtkCommunicator::MarshalDataObject(image, marshalled);
    writer.AddText(
      { marshalled->GetPointer(0), static_cast<std::size_t>(marshalled->GetNumberOfValues()) });
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
    vtkNew<vtkCharArray> marshalled;
    marshalled->SetNumberOfValues(static_cast<vtkIdType>(taken.size()));
    std::memcpy(marshalled->GetPointer(0), taken.data(), taken.size());
    vtkNew<vtkImageData> image;
    vtkCommunicator::UnMarshalDataObject(marshalled, image);
    result.Images.emplace_back(image.Get());
  }
  return result;
}
}
