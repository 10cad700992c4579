// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/VtpDocument.h"

#include "base/NumberText.h"
#include "core/Error.h"
#include "core/PrintableText.h"

#include <algorithm>
#include <utility>

namespace novelview
{
namespace
{
std::string LineOf(const std::string& file, std::string_view bytes, std::size_t at)
{
  const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(at, bytes.size()));
  return file + ", line " + std::to_string(1 + std::count(bytes.begin(), end, '\n'));
}
}

VtpDocument::VtpDocument(std::string_view bytes, std::string file)
  : AllBytes(bytes)
  , File(std::move(file))
{
  // What is appended may be any bytes, so the XML ends before it for the parser.
  const std::size_t appended = bytes.find("<AppendedData");
  if (appended == std::string_view::npos)
  {
    this->Parse(bytes);
    return;
  }
  const std::size_t tagEnd = std::min(bytes.find('>', appended), bytes.size() - 1);
  this->Parse(std::string(bytes.substr(0, tagEnd + 1)) + "</AppendedData></VTKFile>");
  const pugi::xml_node element = this->Root().child("AppendedData");
  const std::string_view encoding = element.attribute("encoding").value();
  if (encoding != "base64" && encoding != "raw")
  {
    throw Error(
      this->Where(element), "unknown encoding of AppendedData", Quoted(encoding), "base64 or raw");
  }
  this->Base64 = encoding == "base64";
  const std::size_t mark = bytes.find_first_not_of(" \t\r\n", tagEnd + 1);
  if (mark == std::string_view::npos || bytes[mark] != '_')
  {
    throw Error(this->Where(element), "no \"_\" at the beginning of AppendedData");
  }
  this->AppendedBytes = bytes.substr(mark + 1);
}

void VtpDocument::Parse(std::string_view text)
{
  const pugi::xml_parse_result result =
    this->Tree.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!result)
  {
    throw Error(LineOf(this->File, text,
                  static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0))),
      "is not well-formed XML");
  }
  const pugi::xml_node root = this->Root();
  const std::string_view type = root.attribute("type").value();
  if (!root || type != "PolyData")
  {
    throw Error(this->Where(root), "is not a VTK file of polygons",
      root ? "the type " + Quoted(type) : "no element VTKFile", "VTKFile of the type \"PolyData\"");
  }
}

std::string VtpDocument::Where(const pugi::xml_node& element) const
{
  return LineOf(this->File, this->AllBytes,
    static_cast<std::size_t>(std::max<std::ptrdiff_t>(element.offset_debug(), 0)));
}

std::uint64_t VtpDocument::Count(
  const pugi::xml_node& element, const char* name, std::uint64_t missing) const
{
  const pugi::xml_attribute attribute = element.attribute(name);
  std::uint64_t count = missing;
  if (attribute && !ParseNumber(std::string_view(attribute.value()), count))
  {
    throw Error(this->Where(element), std::string(element.name()) + " has a malformed " + name,
      Quoted(attribute.value()), "a count");
  }
  return count;
}
}
