// SPDX-License-Identifier: GPL-3.0-or-later
#include "OptionParser.h"

#include <type_traits>

namespace novelview
{
namespace
{
/** What stands behind the flag in the help, and how many words it takes. */
struct Shape
{
  const char* TypeName = "TEXT";
  int MinWords = 1;
  int MaxWords = 1;
};

struct ShapeOf
{
  static constexpr int Many = 1 << 20;

  Shape operator()(const bool*) const { return { "", 0, 0 }; }
  Shape operator()(const int*) const { return { "INT" }; }
  Shape operator()(const double*) const { return { "NUMBER" }; }
  Shape operator()(const std::string*) const { return { "NAME" }; }
  Shape operator()(const std::filesystem::path*) const { return { "PATH" }; }
  Shape operator()(const std::optional<double>*) const { return { "NUMBER" }; }
  Shape operator()(const std::optional<std::array<double, 6>>*) const
  {
    return { "NUMBERS", 6, 6 };
  }
  Shape operator()(const std::vector<std::string>*) const { return { "NAMES", 1, Many }; }
  Shape operator()(const std::vector<std::filesystem::path>*) const { return { "PATHS", 1, Many }; }
  Shape operator()(const std::vector<double>*) const { return { "NUMBERS", 1, Many }; }
  Shape operator()(const std::vector<int>*) const { return { "INTS", 1, Many }; }
  Shape operator()(const WordTarget& target) const { return { target.TypeName }; }
  Shape operator()(const SizeTarget&) const { return { "SIZE" }; }
};

/** Help, unit, range and default in one sentence. */
std::string HelpText(const Option& option)
{
  std::string notes;
  const auto note = [&notes](const std::string& text)
  { notes += (notes.empty() ? "" : "; ") + text; };
  const std::string range = RangeText(option);
  const std::string value = ValueText(option);
  if (!option.Unit.empty())
  {
    note(option.Unit);
  }
  if (!range.empty())
  {
    note(range);
  }
  note(value.empty() ? "default: none" : "default: " + value);
  return option.Help + " (" + notes + ")";
}
}

void OptionParser::AddTo(CLI::App& command, const OptionTable& table)
{
  for (const Option& option : table)
  {
    CLI::Option* added = this->Add(command, option, option.Key);
    if (option.Positional)
    {
      added->required();
    }
    else
    {
      added->group(option.Group);
    }
    for (const std::string& former : option.FormerKeys)
    {
      this->Add(command, option, former)->group(""); // not in the help
    }
  }
}

CLI::Option* OptionParser::Add(CLI::App& command, const Option& option, const std::string& key)
{
  this->Entries.push_back(std::make_unique<Entry>());
  Entry& entry = *this->Entries.back();
  entry.Key = key;
  const std::string flag = option.Positional ? key : FlagOf(key);
  const Shape shape = std::visit(ShapeOf(), option.Target);
  CLI::Option* added = nullptr;
  if (shape.MaxWords == 0)
  {
    const std::string off = "--no-" + flag.substr(2);
    added = command.add_flag(flag + ",!" + off, entry.Words, HelpText(option));
    added->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  }
  else
  {
    added = command.add_option(flag, entry.Words, HelpText(option));
    added->type_name(shape.TypeName)->delimiter(',')->expected(shape.MinWords, shape.MaxWords);
    if (shape.MaxWords == 1)
    {
      // A view contains commas itself.
      added->delimiter('\0')->multi_option_policy(CLI::MultiOptionPolicy::Throw);
    }
  }
  entry.Parsed = added;
  return added;
}

ParsedArguments OptionParser::Given() const
{
  ParsedArguments given;
  for (const auto& entry : this->Entries)
  {
    if (entry->Parsed->count() > 0)
    {
      given.emplace_back(entry->Key, entry->Words);
    }
  }
  return given;
}
}
