// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/VtpArrays.h"

#include "base/ByteStream.h"
#include "base/NumberText.h"
#include "base/TextLines.h"
#include "core/Error.h"
#include "core/PrintableText.h"

#include <algorithm>
#include <array>
#include <type_traits>

namespace novelview
{
namespace
{
/** What a DataArray may contain. */
struct ArrayType
{
  std::string_view Name;
  std::size_t Size; ///< bytes
  bool Integer;
};

constexpr std::array<ArrayType, 10> ArrayTypes = { { { "Int8", 1, true }, { "UInt8", 1, true },
  { "Int16", 2, true }, { "UInt16", 2, true }, { "Int32", 4, true }, { "UInt32", 4, true },
  { "Int64", 8, true }, { "UInt64", 8, true }, { "Float32", 4, false }, { "Float64", 8, false } } };

/** A number of type T, stored as `Stored`. */
template <class T, class Stored>
T Convert(const char* raw, bool swap)
{
  if constexpr (std::is_integral_v<T> && !std::is_integral_v<Stored>)
  {
    return 0; // Read() has refused it
  }
  else
  {
    return static_cast<T>(NumberFrom<Stored>(raw, swap));
  }
}

/** The function for a type. */
template <class T>
T (*Converter(std::string_view type))
(const char*, bool)
{
  constexpr std::array<T (*)(const char*, bool), ArrayTypes.size()> converters = {
    Convert<T, std::int8_t>, Convert<T, std::uint8_t>, Convert<T, std::int16_t>,
    Convert<T, std::uint16_t>, Convert<T, std::int32_t>, Convert<T, std::uint32_t>,
    Convert<T, std::int64_t>, Convert<T, std::uint64_t>, Convert<T, float>, Convert<T, double>
  };
  for (std::size_t i = 0; i < ArrayTypes.size(); ++i)
  {
    if (ArrayTypes[i].Name == type)
    {
      return converters[i];
    }
  }
  return nullptr;
}

/** A number as VTK reads it: one of single precision comes from the text at once. */
bool ParseNumberOf(std::string_view type, std::string_view word, double& number)
{
  float rounded = 0;
  if (type == "Float32" && ParseNumber(word, rounded))
  {
    number = rounded;
    return true;
  }
  return ParseNumber(word, number);
}

bool ParseNumberOf(std::string_view, std::string_view word, std::int64_t& number)
{
  return ParseNumber(word, number);
}

template <class T>
std::vector<T> ParseWords(
  const std::string& text, std::string_view type, std::uint64_t count, const std::string& where)
{
  std::vector<T> numbers;
  TextLines lines(text, {});
  while (lines.NextWithWords())
  {
    for (std::string_view word = lines.Word(); !word.empty(); word = lines.Word())
    {
      T number{};
      if (!ParseNumberOf(type, word, number))
      {
        throw Error(where, "array contains what is not a number", Quoted(word), "a number");
      }
      numbers.push_back(number);
    }
  }
  if (numbers.size() != count)
  {
    throw Error(where, "array has the wrong number of values", std::to_string(numbers.size()),
      std::to_string(count));
  }
  return numbers;
}
}

VtpArrays::VtpArrays(const VtpDocument& document)
  : Document(document)
  , Bytes(document)
{
}

std::vector<double> VtpArrays::ReadNumbers(
  const pugi::xml_node& array, std::uint64_t tuples, std::uint64_t components) const
{
  return this->Read<double>(array, tuples, components);
}

std::vector<std::int64_t> VtpArrays::ReadIntegers(
  const pugi::xml_node& array, std::uint64_t count) const
{
  return this->Read<std::int64_t>(array, count, 1);
}

template <class T>
std::vector<T> VtpArrays::Read(
  const pugi::xml_node& array, std::uint64_t tuples, std::uint64_t components) const
{
  const std::string where = this->Document.Where(array);
  const std::string_view name = array.attribute("type").value();
  const auto type = std::find_if(ArrayTypes.begin(), ArrayTypes.end(),
    [&](const ArrayType& candidate) { return candidate.Name == name; });
  if (type == ArrayTypes.end() || (std::is_integral_v<T> && !type->Integer))
  {
    throw Error(where, "array has an unusable type", Quoted(name),
      std::is_integral_v<T> ? "Int8 to UInt64" : "Int8 to UInt64, Float32 or Float64");
  }
  const std::uint64_t most =
    this->Document.Bytes().size() * MaxExpansion / (type->Size * components);
  if (tuples > most)
  {
    throw Error(where, "the file is too short for its array", std::to_string(tuples) + " values",
      std::to_string(most) + " at most");
  }
  const std::uint64_t count = tuples * components;
  if (std::string_view(array.attribute("format").value()) == "ascii")
  {
    return ParseWords<T>(TextOf(array), name, count, where);
  }
  const std::string bytes = this->Bytes.Read(array, count * type->Size);
  const auto convert = Converter<T>(name);
  const bool swap = this->Bytes.AreSwapped();
  std::vector<T> numbers(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    numbers[i] = convert(bytes.data() + i * type->Size, swap);
  }
  return numbers;
}
}
