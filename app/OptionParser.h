// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OptionParser_h
#define novelview_OptionParser_h

#include "options/Options.h"

#include <CLI/App.hpp>

#include <memory>
#include <string>
#include <vector>

namespace novelview
{
/** Makes command-line options of a table, and keeps the words that were given for them. */
class OptionParser
{
public:
  /** Adds every option with its unit, default and range. Nothing points into the table later. */
  void AddTo(CLI::App& command, const OptionTable& table);

  /** The options that were given, by the keys used, after the command line has been parsed. */
  ParsedArguments Given() const;

private:
  struct Entry
  {
    std::string Key;
    std::vector<std::string> Words;
    const CLI::Option* Parsed = nullptr;
  };

  /** Adds an option by its key or a former one. */
  CLI::Option* Add(CLI::App& command, const Option& option, const std::string& key);

  // CLI11 writes into the words, so the entries must not move.
  std::vector<std::unique_ptr<Entry>> Entries;
};
}

#endif
