// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/NearestWord.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace novelview
{
namespace
{
/** Levenshtein distance. */
std::size_t EditDistance(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{ 0 });
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      const std::size_t replaced = diagonal +
        (std::tolower(static_cast<unsigned char>(a[i])) !=
          std::tolower(static_cast<unsigned char>(b[j])));
      diagonal = row[j + 1];
      row[j + 1] = std::min({ replaced, row[j] + 1, row[j + 1] + 1 });
    }
  }
  return row.back();
}
}

std::string NearestWord(const std::string& word, const std::vector<std::string>& known)
{
  std::string nearest;
  constexpr std::size_t Longest = 100; // nobody misspells such a word, and comparing takes long
  if (word.size() > Longest)
  {
    return nearest;
  }
  // A third of the letters wrong is still a misspelling; more is another word.
  std::size_t least = std::max<std::size_t>(word.size() / 3, 1) + 1;
  for (const std::string& each : known)
  {
    const std::size_t distance = EditDistance(word, each);
    if (distance < least)
    {
      least = distance;
      nearest = each;
    }
  }
  return nearest;
}
}
