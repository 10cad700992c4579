// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/PrintableText.h"

#include <algorithm>
#include <array>

namespace novelview
{
namespace
{
/** Longer texts are cut before anything else is done, so that they cost no time. */
constexpr std::size_t MostLookedAt = 4 * MaxInLine;

unsigned char ByteAt(std::string_view text, std::size_t at)
{
  return static_cast<unsigned char>(text[at]);
}

bool IsContinuation(std::string_view text, std::size_t at)
{
  return (ByteAt(text, at) & 0xC0) == 0x80;
}

char32_t CharacterAt(std::string_view text, std::size_t at, std::size_t length)
{
  char32_t code = ByteAt(text, at) & (length == 1 ? 0x7F : 0xFF >> (length + 1));
  for (std::size_t i = 1; i < length; ++i)
  {
    code = code << 6 | (ByteAt(text, at + i) & 0x3F);
  }
  return code;
}

/** Whether a character moves the cursor, breaks the line or turns the direction of writing. */
bool IsControl(char32_t code)
{
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || (code >= 0x2028 && code <= 0x202E) ||
    (code >= 0x2066 && code <= 0x2069);
}

std::string Escaped(std::string_view bytes)
{
  constexpr char Digits[] = "0123456789ABCDEF";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); ++i)
  {
    text += { '\\', 'x', Digits[ByteAt(bytes, i) >> 4], Digits[ByteAt(bytes, i) & 15] };
  }
  return text;
}
}

std::size_t Utf8Length(std::string_view text, std::size_t at)
{
  const unsigned char first = ByteAt(text, at);
  const std::size_t length = first < 0x80 ? 1
    : first >= 0xC2 && first < 0xE0       ? 2
    : first >= 0xE0 && first < 0xF0       ? 3
    : first >= 0xF0 && first < 0xF5       ? 4
                                          : 0;
  if (length == 0 || length > text.size() - at)
  {
    return 0;
  }
  for (std::size_t i = 1; i < length; ++i)
  {
    if (!IsContinuation(text, at + i))
    {
      return 0;
    }
  }
  // The shortest form only, no halves of surrogate pairs, nothing behind the last character.
  constexpr std::array<char32_t, 5> Min{ 0, 0, 0x80, 0x800, 0x10000 };
  const char32_t code = CharacterAt(text, at, length);
  const bool valid = code >= Min[length] && code <= 0x10FFFF && !(code >= 0xD800 && code <= 0xDFFF);
  return valid ? length : 0;
}

bool IsUtf8(std::string_view text)
{
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t length = Utf8Length(text, at);
    if (length == 0)
    {
      return false;
    }
    at += length;
  }
  return true;
}

std::string ValidUtf8(std::string_view text)
{
  std::string valid;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t length = Utf8Length(text, at);
    valid += length == 0 ? Escaped(text.substr(at, 1)) : std::string(text.substr(at, length));
    at += length == 0 ? 1 : length;
  }
  return valid;
}

std::string Printable(std::string_view text)
{
  std::string line;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t length = Utf8Length(text, at);
    const std::string_view bytes = text.substr(at, length == 0 ? 1 : length);
    if (bytes == "\n" || bytes == "\r" || bytes == "\t")
    {
      line += ' ';
    }
    else if (length == 0 || IsControl(CharacterAt(text, at, length)))
    {
      line += Escaped(bytes);
    }
    else
    {
      line += bytes;
    }
    at += bytes.size();
  }
  return line;
}

std::string Shortened(const std::string& text, std::size_t most)
{
  if (text.size() <= most)
  {
    return text;
  }
  const std::string dots = "...";
  const std::size_t kept = most > dots.size() ? most - dots.size() : 0;
  std::size_t end = kept / 3;
  std::size_t begin = text.size() - (kept - end);
  while (end > 0 && IsContinuation(text, end))
  {
    --end;
  }
  while (begin < text.size() && IsContinuation(text, begin))
  {
    ++begin;
  }
  return text.substr(0, end) + dots + text.substr(begin);
}

std::string PrintableLine(std::string_view text)
{
  if (text.size() <= MostLookedAt)
  {
    return Shortened(Printable(text), MaxInLine);
  }
  // Both ends hold more than is kept of them.
  const std::size_t half = MostLookedAt / 2;
  return Shortened(
    Printable(text.substr(0, half)) + Printable(text.substr(text.size() - half)), MaxInLine);
}

std::string Quoted(std::string_view word)
{
  constexpr std::size_t most = 40;
  std::string text(word.substr(0, most));
  std::replace_if(
    text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
  return "\"" + text + (word.size() > most ? "...\"" : "\"");
}
}
