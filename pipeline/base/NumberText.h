// SPDX-License-Identifier: GPL-3.0-or-later
/** Numbers and words of text files, whatever the locale. */
#ifndef novelview_NumberText_h
#define novelview_NumberText_h

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace novelview
{
/** The shortest text that reads back as the same bits. */
inline std::string NumberText(double value)
{
  char text[64];
  return std::string(text, std::to_chars(text, text + sizeof(text), value).ptr);
}

/** A number as printf would print it. */
inline std::string Formatted(const char* format, double value)
{
  std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, value)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, value);
  return text;
}

/** ASCII letters in lower case. */
inline std::string LowerCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/** The whole text as a number; false when it is none. */
template <class T>
bool ParseNumber(std::string_view text, T& number)
{
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(begin, end, number);
  return failure == std::errc() && stop == end;
}

/** The words between blanks. */
inline std::vector<std::string> Words(const std::string& line)
{
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;)
  {
    words.push_back(word);
  }
  return words;
}

/** Words with something between them. */
inline std::string Joined(const std::vector<std::string>& words, const char* between = ", ")
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : between) + word;
  }
  return text;
}
}

#endif
