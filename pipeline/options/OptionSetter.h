// SPDX-License-Identifier: GPL-3.0-or-later
/** What reading options from words and from JSON have in common; for the .cxx files of this folder. */
#ifndef novelview_OptionSetter_h
#define novelview_OptionSetter_h

#include "base/NumberText.h"
#include "options/Options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

namespace novelview
{
template <class T>
std::string NumbersText(const T& values)
{
  std::vector<std::string> words;
  for (const auto value : values)
  {
    words.push_back(NumberText(value));
  }
  return Joined(words, ",");
}

/** The option that goes, or went, by a key; null when there is none. */
inline const Option* OptionOfKey(const OptionTable& table, const std::string& key)
{
  const auto found = std::find_if(table.begin(), table.end(),
    [&key](const Option& option)
    {
      const std::vector<std::string>& former = option.FormerKeys;
      return option.Key == key || std::find(former.begin(), former.end(), key) != former.end();
    });
  return found == table.end() ? nullptr : &*found;
}

/** x0 y0 z0 x1 y1 z1: every second value must be above the first. */
inline void CheckBox(const std::vector<double>& values, const std::string& where)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!(values[axis] < values[axis + 3]))
    {
      throw UsageError(
        where, "is not a box", NumbersText(values), "x0,y0,z0,x1,y1,z1 with x0 < x1 ...");
    }
  }
}

template <class T>
T ParsedNumber(const std::string& word, const std::string& where)
{
  T number{};
  const char* begin = word.data() + (word.size() > 1 && word[0] == '+' ? 1 : 0);
  const char* end = word.data() + word.size();
  const auto [stop, failure] = std::from_chars(begin, end, number);
  if (failure != std::errc() || stop != end)
  {
    throw UsageError(where,
      std::string("is not a ") + (std::is_integral_v<T> ? "whole number" : "number"),
      "'" + word + "'", std::is_integral_v<T> ? "a whole number" : "a number");
  }
  return number;
}

/** Checks values of the types that options have, whatever they were read from. */
class OptionSetter
{
public:
  OptionSetter(const Option& option, std::string where)
    : Target(option)
    , Where(std::move(where))
  {
  }

  template <class T>
  T InRange(T value) const
  {
    // Written so that a NaN is out of every range.
    if (!(value >= this->Target.Min && value <= this->Target.Max))
    {
      throw UsageError(this->Where, "is out of range", NumberText(value), RangeText(this->Target));
    }
    if (!std::isfinite(static_cast<double>(value)))
    {
      throw UsageError(this->Where, "is not finite", NumberText(value), "a finite number");
    }
    return value;
  }
  std::string OfChoices(const std::string& word) const
  {
    const std::vector<std::string>& choices = this->Target.Choices;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), word) == choices.end())
    {
      throw UsageError(
        this->Where, "is not a valid choice", "'" + word + "'", RangeText(this->Target));
    }
    return word;
  }
  void SetSize(const SizeTarget& target, const std::string& word) const
  {
    const std::size_t cross = word.find('x');
    if (cross == std::string::npos)
    {
      throw UsageError(this->Where, "is not a size", "'" + word + "'", "like 640x480");
    }
    *target.Width = this->InRange(ParsedNumber<int>(word.substr(0, cross), this->Where));
    *target.Height = this->InRange(ParsedNumber<int>(word.substr(cross + 1), this->Where));
  }

protected:
  const Option& Target;
  std::string Where;
};
}

#endif
