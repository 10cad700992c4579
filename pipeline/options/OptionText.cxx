// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/OptionSetter.h"

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/** Sets a target from words of a command line. */
class TextSetter : public OptionSetter
{
public:
  TextSetter(const Option& option, const std::vector<std::string>& words)
    : OptionSetter(option, FlagOf(option.Key))
    , Words(words)
  {
  }

  void operator()(bool* target) const
  {
    const std::string word = this->One();
    if (word != "true" && word != "false")
    {
      throw UsageError(this->Where, "is a switch", "'" + word + "'", "true or false");
    }
    *target = word == "true";
  }
  void operator()(int* target) const { *target = this->Number<int>(this->One()); }
  void operator()(double* target) const { *target = this->Number<double>(this->One()); }
  void operator()(std::string* target) const { *target = this->OfChoices(this->One()); }
  void operator()(fs::path* target) const { *target = this->One(); }
  void operator()(std::optional<double>* target) const
  {
    *target = this->Number<double>(this->One());
  }
  void operator()(std::optional<std::array<double, 6>>* target) const
  {
    const std::vector<double> values = this->Numbers<double>();
    if (values.size() != 6)
    {
      throw UsageError(
        this->Where, "has the wrong length", std::to_string(values.size()) + " numbers", "6");
    }
    CheckBox(values, this->Where);
    target->emplace();
    std::copy(values.begin(), values.end(), (*target)->begin());
  }
  void operator()(std::vector<std::string>* target) const { *target = this->Words; }
  void operator()(std::vector<fs::path>* target) const
  {
    target->assign(this->Words.begin(), this->Words.end());
  }
  void operator()(std::vector<double>* target) const { *target = this->Numbers<double>(); }
  void operator()(std::vector<int>* target) const { *target = this->Numbers<int>(); }
  void operator()(const WordTarget& target) const
  {
    target.Set(this->One(), this->Where, [](const fs::path& path) { return path; });
  }
  void operator()(const SizeTarget& target) const { this->SetSize(target, this->One()); }

private:
  const std::string& One() const
  {
    if (this->Words.size() != 1)
    {
      throw UsageError(
        this->Where, "takes one value", std::to_string(this->Words.size()) + " values", "1");
    }
    return this->Words.front();
  }
  template <class T>
  T Number(const std::string& word) const
  {
    return this->InRange(ParsedNumber<T>(word, this->Where));
  }
  template <class T>
  std::vector<T> Numbers() const
  {
    std::vector<T> values;
    for (const std::string& word : this->Words)
    {
      values.push_back(this->Number<T>(word));
    }
    return values;
  }

  const std::vector<std::string>& Words;
};
}

void SetFromText(const Option& option, const std::vector<std::string>& words)
{
  std::visit(TextSetter(option, words), option.Target);
}

void SetFromArguments(
  const OptionTable& table, const ParsedArguments& given, const OptionWarning& warn)
{
  for (const auto& [key, words] : given)
  {
    const Option& option = FindOption(table, key);
    if (key != option.Key)
    {
      const std::string text = "is now " + FlagOf(option.Key);
      if (std::any_of(given.begin(), given.end(),
            [&option](const auto& each) { return each.first == option.Key; }))
      {
        throw UsageError(FlagOf(key), text + ", which is given, too");
      }
      if (warn)
      {
        warn(FlagOf(key) + " " + text);
      }
    }
    SetFromText(option, words);
  }
}
}
