// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/PlyHeader.h"

#include "base/NumberText.h"
#include "core/Error.h"
#include "core/PrintableText.h"

#include <algorithm>
#include <map>

namespace novelview
{
namespace
{
/** Elements in a file, and properties of one: more than any file needs. */
constexpr std::size_t Max = 1000;

PlyType TypeNamed(TextLines& lines)
{
  static const std::map<std::string_view, PlyType> types = {
    { "char", { 1, PlyType::Signed } },
    { "int8", { 1, PlyType::Signed } },
    { "uchar", { 1, PlyType::Unsigned } },
    { "uint8", { 1, PlyType::Unsigned } },
    { "short", { 2, PlyType::Signed } },
    { "int16", { 2, PlyType::Signed } },
    { "ushort", { 2, PlyType::Unsigned } },
    { "uint16", { 2, PlyType::Unsigned } },
    { "int", { 4, PlyType::Signed } },
    { "int32", { 4, PlyType::Signed } },
    { "uint", { 4, PlyType::Unsigned } },
    { "uint32", { 4, PlyType::Unsigned } },
    { "float", { 4, PlyType::Float } },
    { "float32", { 4, PlyType::Float } },
    { "double", { 8, PlyType::Float } },
    { "float64", { 8, PlyType::Float } },
  };
  const std::string_view name = lines.Word();
  const auto type = types.find(name);
  if (type == types.end())
  {
    throw Error(lines.Where(), "unknown type of a property", Quoted(name),
      "char, uchar, short, ushort, int, uint, float or double");
  }
  return type->second;
}

PlyEncoding ReadEncoding(TextLines& lines)
{
  const std::string_view name = lines.Word();
  const std::string_view version = lines.Word();
  if (version != "1.0")
  {
    throw Error(lines.Where(), "unknown version of the format", Quoted(version), "1.0");
  }
  if (name == "ascii")
  {
    return PlyEncoding::Ascii;
  }
  if (name == "binary_little_endian")
  {
    return PlyEncoding::LittleEndian;
  }
  if (name == "binary_big_endian")
  {
    return PlyEncoding::BigEndian;
  }
  throw Error(lines.Where(), "unknown format", Quoted(name),
    "ascii, binary_little_endian or binary_big_endian");
}

/** Elements and properties have names that no other has. */
template <class Named>
void CheckNew(const Named& one, const std::vector<Named>& others, const std::string& kind,
  const std::string& where)
{
  if (std::any_of(
        others.begin(), others.end(), [&](const Named& other) { return other.Name == one.Name; }))
  {
    throw Error(where, kind + " " + Quoted(one.Name) + " is there twice");
  }
  if (others.size() >= Max)
  {
    throw Error(where, "too many of the kind " + kind, "more", std::to_string(Max) + " at most");
  }
}

PlyElement ReadElement(TextLines& lines, const std::vector<PlyElement>& others)
{
  PlyElement element;
  element.Where = lines.Where();
  element.Name = lines.Word();
  const std::string_view count = lines.Word();
  if (element.Name.empty() || !ParseNumber(count, element.Count))
  {
    throw Error(element.Where, "element without a number of instances", Quoted(count), "a count");
  }
  CheckNew(element, others, "element", element.Where);
  return element;
}

PlyProperty ReadProperty(TextLines& lines)
{
  PlyProperty property;
  TextLines ahead = lines;
  if (ahead.Word() == "list")
  {
    lines.Word();
    property.CountType = TypeNamed(lines);
    if (!property.CountType.IsInteger())
    {
      throw Error(lines.Where(), "the length of a list must be an integer");
    }
  }
  property.Type = TypeNamed(lines);
  property.Name = lines.Word();
  if (property.Name.empty())
  {
    throw Error(lines.Where(), "property without a name");
  }
  return property;
}

void AddProperty(TextLines& lines, PlyHeader& header)
{
  if (header.Elements.empty())
  {
    throw Error(lines.Where(), "property before the first element");
  }
  std::vector<PlyProperty>& properties = header.Elements.back().Properties;
  PlyProperty property = ReadProperty(lines);
  CheckNew(property, properties, "property", lines.Where());
  properties.push_back(std::move(property));
}
}

PlyHeader ReadPlyHeader(TextLines& lines)
{
  if (!lines.Next() || lines.Word() != "ply" || !lines.Rest().empty())
  {
    throw Error(lines.Where(), "is not a PLY file: the first line is not \"ply\"");
  }
  PlyHeader header;
  bool hasFormat = false;
  while (lines.Next())
  {
    const std::string_view keyword = lines.Word();
    if (keyword == "comment" || keyword == "obj_info" || keyword.empty())
    {
      continue;
    }
    if (keyword == "format")
    {
      header.Encoding = ReadEncoding(lines);
      hasFormat = true;
    }
    else if (keyword == "element")
    {
      header.Elements.push_back(ReadElement(lines, header.Elements));
    }
    else if (keyword == "property")
    {
      AddProperty(lines, header);
    }
    else if (keyword != "end_header")
    {
      throw Error(lines.Where(), "unknown keyword of a PLY header", Quoted(keyword),
        "format, element, property, comment, obj_info or end_header");
    }
    if (!lines.Rest().empty())
    {
      throw Error(lines.Where(), "line continues after its end", Quoted(lines.Rest()), "nothing");
    }
    if (keyword == "end_header")
    {
      if (!hasFormat)
      {
        throw Error(lines.Where(), "the header of the PLY file names no format");
      }
      return header;
    }
  }
  throw Error(lines.Where(), "the header of the PLY file has no end_header");
}
}
