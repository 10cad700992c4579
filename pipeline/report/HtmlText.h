// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_HtmlText_h
#define novelview_HtmlText_h

#include <string>

namespace novelview
{
/** For HTML and SVG, as text or as an attribute in double quotes. */
std::string HtmlEscaped(const std::string& text);
}

#endif
