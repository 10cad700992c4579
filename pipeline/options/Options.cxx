// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/Options.h"

#include "base/NumberText.h"
#include "options/OptionSetter.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace novelview
{
namespace
{
struct TextGetter
{
  std::string operator()(const bool* target) const { return *target ? "true" : "false"; }
  std::string operator()(const int* target) const { return std::to_string(*target); }
  std::string operator()(const double* target) const { return NumberText(*target); }
  std::string operator()(const std::string* target) const { return *target; }
  std::string operator()(const std::filesystem::path* target) const { return target->string(); }
  std::string operator()(const std::optional<double>* target) const
  {
    return *target ? NumberText(**target) : "";
  }
  std::string operator()(const std::optional<std::array<double, 6>>* target) const
  {
    return *target ? NumbersText(**target) : "";
  }
  std::string operator()(const std::vector<std::string>* target) const
  {
    return Joined(*target, ",");
  }
  std::string operator()(const std::vector<std::filesystem::path>* target) const
  {
    return Joined({ target->begin(), target->end() }, ",");
  }
  std::string operator()(const std::vector<double>* target) const { return NumbersText(*target); }
  std::string operator()(const std::vector<int>* target) const { return NumbersText(*target); }
  std::string operator()(const WordTarget& target) const
  {
    return target.Get([](const std::filesystem::path& path) { return path; });
  }
  std::string operator()(const SizeTarget& target) const
  {
    return SizeText(*target.Width, *target.Height);
  }
};

/** Checks the value that a target has. */
class ValueChecker : public OptionSetter
{
public:
  using OptionSetter::OptionSetter;

  void operator()(int* target) const { this->InRange(*target); }
  void operator()(double* target) const { this->InRange(*target); }
  void operator()(std::string* target) const { this->OfChoices(*target); }
  void operator()(std::optional<double>* target) const
  {
    if (*target)
    {
      this->InRange(**target);
    }
  }
  void operator()(std::vector<int>* target) const { this->Each(*target); }
  void operator()(std::vector<double>* target) const { this->Each(*target); }
  void operator()(const SizeTarget& target) const
  {
    this->InRange(*target.Width);
    this->InRange(*target.Height);
  }
  /** Of any other value all are good. */
  template <class T>
  void operator()(const T&) const
  {
  }

private:
  template <class T>
  void Each(const std::vector<T>& values) const
  {
    for (const T value : values)
    {
      this->InRange(value);
    }
  }
};
}

std::string FlagOf(const std::string& key)
{
  std::string flag = "--";
  for (const char c : key)
  {
    if (std::isupper(static_cast<unsigned char>(c)))
    {
      flag += '-';
    }
    flag += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return flag;
}

std::string ValueText(const Option& option)
{
  return std::visit(TextGetter(), option.Target);
}

std::string RangeText(const Option& option)
{
  if (!option.Choices.empty())
  {
    return Joined(option.Choices);
  }
  if (const auto* word = std::get_if<WordTarget>(&option.Target))
  {
    return word->Range;
  }
  const bool from = std::isfinite(option.Min);
  const bool to = std::isfinite(option.Max);
  if (from && to)
  {
    return NumberText(option.Min) + " to " + NumberText(option.Max);
  }
  return from ? "at least " + NumberText(option.Min)
              : (to ? "at most " + NumberText(option.Max) : "");
}

void CheckValues(const OptionTable& table, const std::string& where)
{
  for (const Option& option : table)
  {
    std::visit(ValueChecker(option, where + ", " + option.Key), option.Target);
  }
}

void AppendOptions(OptionTable& table, OptionTable more)
{
  table.insert(
    table.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

const Option& FindOption(const OptionTable& table, const std::string& key)
{
  const Option* option = OptionOfKey(table, key);
  if (!option)
  {
    throw UsageError(FlagOf(key), "is not an option of this command");
  }
  return *option;
}
}
