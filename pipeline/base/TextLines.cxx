// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/TextLines.h"

#include <algorithm>
#include <utility>

namespace novelview
{
namespace
{
constexpr std::string_view Blanks = " \t\r\v\f";

std::string_view WithoutLeadingBlanks(std::string_view text)
{
  text.remove_prefix(std::min(text.find_first_not_of(Blanks), text.size()));
  return text;
}
}

TextLines::TextLines(std::string_view text, std::string file)
  : Text(text)
  , Name(std::move(file))
{
}

bool TextLines::Next()
{
  if (this->After >= this->Text.size())
  {
    return false;
  }
  const std::size_t end = std::min(this->Text.find('\n', this->After), this->Text.size());
  this->Line = this->Text.substr(this->After, end - this->After);
  this->After = std::min(end + 1, this->Text.size());
  ++this->Number;
  return true;
}

bool TextLines::NextWithWords()
{
  while (this->Next())
  {
    if (!this->Rest().empty())
    {
      return true;
    }
  }
  return false;
}

std::string_view TextLines::Word()
{
  this->Line = WithoutLeadingBlanks(this->Line);
  const std::size_t length = std::min(this->Line.find_first_of(Blanks), this->Line.size());
  const std::string_view word = this->Line.substr(0, length);
  this->Line.remove_prefix(length);
  return word;
}

std::string_view TextLines::Rest() const
{
  const std::string_view rest = WithoutLeadingBlanks(this->Line);
  return rest.substr(0, rest.find_last_not_of(Blanks) + 1);
}

std::string TextLines::Where() const
{
  return this->Name + ", line " + std::to_string(std::max<std::size_t>(this->Number, 1));
}
}
