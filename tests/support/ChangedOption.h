// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef support_ChangedOption_h
#define support_ChangedOption_h

#include "options/Options.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace support
{
/** Gives the value of an option another one that it may have. */
class ValueChanger
{
public:
  explicit ValueChanger(const novelview::Option& option)
    : Changed(option)
  {
  }

  void operator()(bool* value) const { *value = !*value; }
  void operator()(int* value) const { *value += *value + 2 <= this->Changed.Max ? 2 : -2; }
  void operator()(double* value) const
  {
    *value += *value + 0.25 <= this->Changed.Max ? 0.25 : -0.25;
  }
  void operator()(std::string* value) const
  {
    const std::vector<std::string>& choices = this->Changed.Choices;
    const auto other = std::find_if(choices.begin(), choices.end(),
      [value](const std::string& choice) { return choice != *value; });
    *value = other == choices.end() ? *value + "other" : *other;
  }
  void operator()(std::filesystem::path* value) const { *value += "elsewhere"; }
  void operator()(std::optional<double>* value) const { *value = value->value_or(0) + 0.25; }
  void operator()(std::optional<std::array<double, 6>>* value) const
  {
    *value = { 0, 0, 0, 1, 1, 1 };
  }
  void operator()(std::vector<std::string>* value) const { value->push_back("one, more"); }
  void operator()(std::vector<double>* value) const { value->push_back(2.5); }
  void operator()(std::vector<int>* value) const { value->push_back(3); }
  void operator()(std::vector<std::filesystem::path>* value) const { value->push_back("more"); }
  void operator()(const novelview::WordTarget& value) const
  {
    // The first or the second word of those that take a list, or a novel view.
    const auto same = [](const std::filesystem::path& path) { return path; };
    const std::string& list = value.Range;
    std::string word = list.empty() ? "between:1,2,0.25" : list.substr(0, list.find(','));
    if (word == value.Get(same))
    {
      const std::size_t second = list.find(", ") + 2;
      word = list.substr(second, list.find(',', second) - second);
    }
    value.Set(word, "test", same);
  }
  void operator()(const novelview::SizeTarget& value) const
  {
    *value.Width += 2;
    *value.Height += 3;
  }

private:
  const novelview::Option& Changed;
};

/** Changes the value of an option, within its range. */
inline void ChangeValue(const novelview::Option& option)
{
  const std::string before = novelview::ValueText(option);
  std::visit(ValueChanger(option), option.Target);
  ASSERT_NE(novelview::ValueText(option), before) << option.Key;
}
}

#endif
