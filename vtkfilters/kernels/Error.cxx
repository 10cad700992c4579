// SPDX-License-Identifier: GPL-3.0-or-later
#include "Error.h"

namespace novelview
{
namespace
{
std::string OneLine(std::string text)
{
  for (char& c : text)
  {
    if (c == '\n' || c == '\r' || c == '\t')
    {
      c = ' ';
    }
  }
  return text;
}
}

Error::Error(const std::string& where, const std::string& what)
  : std::runtime_error(OneLine(where + ": " + what))
{
}

Error::Error(const std::string& where, const std::string& what, const std::string& got,
  const std::string& expected)
  : std::runtime_error(
      OneLine(where + ": " + what + " (got " + got + ", expected " + expected + ")"))
{
}

Interrupted::Interrupted()
  : Error("interrupted", "stopped on request")
{
}

std::string SizeText(int width, int height)
{
  return std::to_string(width) + "x" + std::to_string(height);
}
}
