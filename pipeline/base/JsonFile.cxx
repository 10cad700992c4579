// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/JsonFile.h"

#include "base/InputFile.h"
#include "core/Error.h"
#include "core/PrintableText.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
using Json = nlohmann::ordered_json;

const char* const Blanks = " \t\r\n";

/** "job.json, line 3, column 7" of a byte of a text. */
std::string PlaceOf(const std::string& text, std::size_t at, const std::string& where)
{
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(at, text.size()));
  const auto line = 1 + std::count(text.begin(), end, '\n');
  const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  const std::size_t column = before == std::string::npos ? at + 1 : at - before;
  return where + ", line " + std::to_string(line) + ", column " + std::to_string(column);
}

/** The next few bytes, for a message. */
std::string WordAt(const std::string& text, std::size_t at)
{
  constexpr std::size_t Max = 20;
  if (at >= text.size())
  {
    return "the end";
  }
  const std::size_t end = text.find_first_of(",:[]{} \t\r\n", at + 1);
  return "'" + text.substr(at, std::min(end == std::string::npos ? end : end - at, Max)) + "'";
}

/** Where the text or word that begins at `at` ends. */
std::size_t TokenEnd(const std::string& text, std::size_t at)
{
  const std::string signs = ",:[]{}";
  if (signs.find(text[at]) != std::string::npos)
  {
    return at + 1;
  }
  if (text[at] != '"')
  {
    return std::min(text.find_first_of(signs + "\"" + Blanks, at), text.size());
  }
  for (++at; at < text.size() && text[at] != '"'; ++at)
  {
    at += text[at] == '\\' ? 1 : 0;
  }
  return std::min(at + 1, text.size());
}

/** Where the token begins of which a parser has read the last byte it wanted, counted from 1. */
std::size_t TokenBegin(const std::string& text, std::size_t position)
{
  std::size_t at = text.find_first_not_of(Blanks);
  while (at < text.size())
  {
    const std::size_t end = TokenEnd(text, at);
    if (end >= position)
    {
      return at;
    }
    at = text.find_first_not_of(Blanks, end);
  }
  return text.size();
}

void CheckEncoding(const std::string& text, const std::string& where)
{
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t length = Utf8Length(text, at);
    if (length == 0)
    {
      throw Error(PlaceOf(text, at, where), "is not JSON: its text is not UTF-8");
    }
    at += length;
  }
}

/** Beforehand, since values are copied and written by recursion. */
void CheckNesting(const std::string& text, const std::string& where)
{
  int depth = 0;
  bool quoted = false;
  for (std::size_t at = 0; at < text.size(); ++at)
  {
    const char c = text[at];
    if (quoted)
    {
      at += c == '\\' ? 1 : 0;
      quoted = c != '"';
      continue;
    }
    quoted = c == '"';
    depth += c == '[' || c == '{' ? 1 : (c == ']' || c == '}' ? -1 : 0);
    if (depth > MaxJsonNesting)
    {
      throw Error(PlaceOf(text, at, where), "JSON is nested too deep",
        "more than " + std::to_string(MaxJsonNesting) + " levels", "fewer");
    }
  }
}

/** Builds the value, and reports where a text is not JSON. */
class JsonExaminer : public nlohmann::json_sax<Json>
{
public:
  JsonExaminer(const std::string& text, const std::string& where, Json& value)
    : Text(text)
    , Where(where)
    , Root(value)
  {
  }

  bool null() override { return this->Add(nullptr); }
  bool boolean(bool value) override { return this->Add(value); }
  bool number_integer(number_integer_t value) override { return this->Add(value); }
  bool number_unsigned(number_unsigned_t value) override { return this->Add(value); }
  bool number_float(number_float_t value, const string_t&) override { return this->Add(value); }
  bool string(string_t& value) override { return this->Add(std::move(value)); }
  bool binary(binary_t& value) override { return this->Add(Json::binary(std::move(value))); }

  bool start_object(std::size_t) override
  {
    this->Open.push_back({ &this->Put(Json::object()), {} });
    this->Last = Event::OpenedObject;
    return true;
  }
  bool start_array(std::size_t) override
  {
    this->Open.push_back({ &this->Put(Json::array()), {} });
    this->Last = Event::OpenedArray;
    return true;
  }
  bool end_object() override
  {
    this->Open.pop_back();
    this->Last = Event::Value;
    return true;
  }
  bool end_array() override { return this->end_object(); }

  bool key(string_t& name) override
  {
    if (!this->Open.back().Keys.insert(name).second)
    {
      throw Error(this->Where, "key \"" + name + "\" is there twice");
    }
    this->Member = &(*this->Open.back().Value)[name];
    this->Last = Event::Key;
    return true;
  }

  bool parse_error(std::size_t position, const std::string& /*token*/,
    const nlohmann::detail::exception& error) override
  {
    constexpr int OutOfRange = 406;
    const std::size_t begin = TokenBegin(this->Text, position);
    const std::string place = PlaceOf(this->Text, begin, this->Where);
    if (error.id == OutOfRange)
    {
      throw Error(place, "number is out of range", WordAt(this->Text, begin), "at most 1.8e308");
    }
    throw Error(place, "is not JSON", WordAt(this->Text, begin), this->Expected(begin));
  }

private:
  enum class Event
  {
    Begin,
    OpenedObject,
    OpenedArray,
    Key,
    Value
  };

  /** An object or array that has not ended. */
  struct Level
  {
    Json* Value;
    std::set<std::string> Keys;
  };

  bool Add(Json value)
  {
    this->Put(std::move(value));
    this->Last = Event::Value;
    return true;
  }

  /** Puts a value where it belongs. */
  Json& Put(Json value)
  {
    if (this->Open.empty())
    {
      return this->Root = std::move(value);
    }
    Json& level = *this->Open.back().Value;
    if (level.is_array())
    {
      level.push_back(std::move(value));
      return level.back();
    }
    return *this->Member = std::move(value);
  }

  /** What is expected at a position, from the last character before it. */
  std::string Expected(std::size_t at) const
  {
    const std::size_t before =
      at == 0 ? std::string::npos : this->Text.find_last_not_of(Blanks, at - 1);
    const char sign = before == std::string::npos ? '\0' : this->Text[before];
    if (this->Last == Event::Begin || this->Open.empty())
    {
      return this->Last == Event::Begin ? "a value" : "the end";
    }
    const bool inArray = this->Open.back().Value->is_array();
    if (this->Last == Event::Key)
    {
      return sign == ':' ? "a value" : "':' and a value";
    }
    if (this->Last == Event::Value && sign != ',')
    {
      return inArray ? "',' or ']'" : "',' or '}'";
    }
    return inArray ? (sign == ',' ? "a value" : "a value or ']'")
                   : (sign == ',' ? "a key in quotes" : "a key in quotes or '}'");
  }

  const std::string& Text;
  const std::string& Where;
  Json& Root;
  std::vector<Level> Open;
  Json* Member = nullptr; ///< of the innermost object: that of the last key
  Event Last = Event::Begin;
};
}

Json ParseJson(const std::string& text, const std::string& where)
{
  CheckEncoding(text, where);
  CheckNesting(text, where);
  Json value;
  JsonExaminer examiner(text, where, value);
  Json::sax_parse(text, &examiner);
  return value;
}

Json ReadJsonFile(const fs::path& path)
{
  return ParseJson(ReadInputFile(path), path.string());
}

std::string DumpJson(const Json& value, int indent)
{
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string JsonTypeText(const Json& value)
{
  return std::string(value.type_name()) + " " + Shortened(DumpJson(value, -1), 40);
}
}
