// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/HtmlText.h"

#include "base/JsonFile.h"

namespace novelview
{
std::string HtmlEscaped(const std::string& text)
{
  const std::string clean = nlohmann::ordered_json::parse(DumpJson(text, -1)).get<std::string>();
  std::string escaped;
  for (const char c : clean)
  {
    switch (c)
    {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}
}
