// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/PlyValues.h"

#include "base/ByteStream.h"
#include "base/NumberText.h"
#include "core/Error.h"
#include "core/PrintableText.h"

#include <bit>

namespace novelview
{
static_assert(std::endian::native == std::endian::little);

namespace
{
/** Throws Error when `left` bytes cannot be `count` instances of `size` bytes at least. */
void CheckBytes(const PlyElement& element, std::uint64_t left, std::uint64_t size)
{
  if (element.Count > 0 && size == 0)
  {
    throw Error(element.Where, "element " + Quoted(element.Name) + " has no properties");
  }
  if (element.Count > 0 && element.Count > left / size)
  {
    throw Error(element.Where,
      "the file is too short for the element " + Quoted(element.Name) + " " +
        std::to_string(element.Count),
      std::to_string(left) + " bytes",
      "at least " + std::to_string(size) + " for each of " + std::to_string(element.Count));
  }
}

class AsciiValues : public PlyValues
{
public:
  AsciiValues(std::string_view bytes, TextLines& lines)
    : Size(bytes.size())
    , Lines(lines)
  {
  }

  void BeginInstance() override
  {
    if (!this->Lines.NextWithWords())
    {
      throw Error(this->Where(), "file ends too early");
    }
  }

  void EndInstance() override
  {
    if (!this->Lines.Rest().empty())
    {
      throw Error(this->Where(), "line has more numbers than the header states",
        Quoted(this->Lines.Rest()), "nothing");
    }
  }

  double Take(const PlyType&) override
  {
    const std::string_view word = this->Lines.Word();
    double number = 0;
    if (word.empty())
    {
      throw Error(this->Where(), "line has fewer numbers than the header and its lists state");
    }
    if (!ParseNumber(word, number))
    {
      throw Error(this->Where(), "is not a number", Quoted(word), "a number");
    }
    return number;
  }

  void Skip(std::int64_t count, const PlyType& type) override
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->Take(type);
    }
  }

  void CheckLength(const PlyElement& element) const override
  {
    // A number has a digit and a blank or line end behind it, which may be missing at the very end.
    CheckBytes(element, this->Size - this->Lines.Position() + 1, 2 * element.Properties.size());
  }

  void Finish() override
  {
    if (this->Lines.NextWithWords())
    {
      throw Error(this->Where(), "file continues after its end", Quoted(this->Lines.Rest()),
        "nothing behind the last element");
    }
  }

  std::string Where() const override { return this->Lines.Where(); }

private:
  std::size_t Size;
  TextLines& Lines;
};

class BinaryValues : public PlyValues
{
public:
  BinaryValues(std::string_view bytes, const TextLines& lines, bool swap)
    : Cursor(bytes, lines.Position())
    , File(lines.File())
    , Swap(swap)
  {
  }

  void BeginInstance() override {}
  void EndInstance() override {}

  double Take(const PlyType& type) override
  {
    const char* raw = this->TakeBytes(1, type).data();
    const bool isSigned = type.Kind == PlyType::Signed;
    if (type.Kind == PlyType::Float)
    {
      return type.Size == 4 ? this->As<float>(raw) : this->As<double>(raw);
    }
    switch (type.Size)
    {
      case 1:
        return isSigned ? this->As<std::int8_t>(raw) : this->As<std::uint8_t>(raw);
      case 2:
        return isSigned ? this->As<std::int16_t>(raw) : this->As<std::uint16_t>(raw);
      default:
        return isSigned ? this->As<std::int32_t>(raw) : this->As<std::uint32_t>(raw);
    }
  }

  void Skip(std::int64_t count, const PlyType& type) override
  {
    this->TakeBytes(static_cast<std::uint64_t>(count), type);
  }

  void CheckLength(const PlyElement& element) const override
  {
    std::uint64_t size = 0;
    for (const PlyProperty& property : element.Properties)
    {
      size += static_cast<std::uint64_t>(
        property.IsList() ? property.CountType.Size : property.Type.Size);
    }
    CheckBytes(element, this->Cursor.Left(), size);
  }

  void Finish() override
  {
    const std::string_view rest = this->Cursor.Rest();
    if (rest.find_first_not_of(" \t\r\n") != std::string_view::npos)
    {
      throw Error(this->Where(), "file continues after its end",
        std::to_string(rest.size()) + " bytes more", "nothing behind the last element");
    }
  }

  std::string Where() const override
  {
    return this->File + ", byte " + std::to_string(this->Cursor.Position());
  }

private:
  template <class T>
  double As(const char* raw) const
  {
    return static_cast<double>(NumberFrom<T>(raw, this->Swap));
  }

  std::string_view TakeBytes(std::uint64_t count, const PlyType& type)
  {
    if (const auto taken = this->Cursor.Take(count, static_cast<std::size_t>(type.Size)))
    {
      return *taken;
    }
    throw Error(this->Where(), "file ends too early",
      std::to_string(this->Cursor.Left()) + " bytes more",
      std::to_string(count) + " numbers of " + std::to_string(type.Size) + " bytes");
  }

  ByteCursor Cursor;
  std::string File;
  bool Swap;
};
}

std::unique_ptr<PlyValues> MakePlyValues(
  PlyEncoding encoding, std::string_view bytes, TextLines& lines)
{
  if (encoding == PlyEncoding::Ascii)
  {
    return std::make_unique<AsciiValues>(bytes, lines);
  }
  return std::make_unique<BinaryValues>(bytes, lines, encoding == PlyEncoding::BigEndian);
}
}
