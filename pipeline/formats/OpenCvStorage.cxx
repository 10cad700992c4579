// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/OpenCvStorage.h"

#include "base/InputFile.h"
#include "base/JsonFile.h"
#include "core/Error.h"
#include "formats/OpenCvStorageXml.h"
#include "formats/OpenCvStorageYaml.h"

#include <algorithm>
#include <iterator>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
using Kind = StorageNode::Kind;

/** OpenCV writes them as \', which is not JSON. */
std::string WithoutEscapedApostrophes(const std::string& text)
{
  std::string valid;
  for (std::size_t at = 0; at < text.size(); ++at)
  {
    const bool escape = text[at] == '\\' && at + 1 < text.size();
    if (escape && text[at + 1] != '\'')
    {
      valid += text[at];
    }
    at += escape ? 1 : 0;
    valid += text[at];
  }
  return valid;
}

StorageNode NodeOf(const nlohmann::ordered_json& value)
{
  StorageNode node;
  if (value.is_object())
  {
    node.What = Kind::Map;
    for (const auto& [key, each] : value.items())
    {
      node.Entries.push_back({ key, NodeOf(each) });
    }
  }
  else if (value.is_array())
  {
    node.What = Kind::List;
    std::transform(value.begin(), value.end(), std::back_inserter(node.Items), NodeOf);
  }
  else if (value.is_string())
  {
    node.What = Kind::Text;
    node.Text = value.get<std::string>();
  }
  else if (!value.is_null())
  {
    node.What = Kind::Number;
    node.Number = value.is_boolean() ? value.get<bool>() : value.get<double>();
    node.Text = DumpJson(value, -1);
  }
  return node;
}

StorageNode ParseStorageJson(const std::string& text, const std::string& where)
{
  return NodeOf(ParseJson(WithoutEscapedApostrophes(text), where));
}
}

StorageNode ParseOpenCvStorage(const std::string& text, const std::string& where)
{
  if (text.size() > MaxStorageBytes)
  {
    throw Error(where, "is too large for a calibration", "more than 32 MiB", "less");
  }
  const std::size_t mark = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  const std::size_t first = text.find_first_not_of(" \t\r\n", mark);
  const char sign = first == std::string::npos ? '\0' : text[first];
  return sign == '<' ? ParseStorageXml(text, where)
    : sign == '{'    ? ParseStorageJson(text, where)
                     : ParseStorageYaml(text, where);
}

StorageNode ReadOpenCvStorage(const fs::path& file)
{
  return ParseOpenCvStorage(ReadInputStart(file, MaxStorageBytes + 1), file.string());
}
}
