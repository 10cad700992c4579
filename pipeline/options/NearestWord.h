// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_NearestWord_h
#define novelview_NearestWord_h

#include <string>
#include <vector>

namespace novelview
{
/** The known word nearest to a misspelt one by edit distance; empty when none is near. */
std::string NearestWord(const std::string& word, const std::vector<std::string>& known);
}

#endif
