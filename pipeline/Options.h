// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Options as tables: one line per option says its key, help, unit, range and where its value lives.
 * Reading and writing JSON, command-line options and --help all come from the same table.
 */
#ifndef novelview_Options_h
#define novelview_Options_h

#include "Synthesis.h"
#include "UsageError.h"
#include "ViewSpec.h"

#include <nlohmann/json.hpp>

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace novelview
{
/** Width and height as one option, "640x480". */
struct SizeTarget
{
  int* Width;
  int* Height;
};

/** Where the value of an option lives; the type says what it accepts. */
using OptionTarget =
  std::variant<bool*, int*, double*, std::string*, std::filesystem::path*, std::optional<double>*,
    std::optional<std::array<double, 6>>*, std::vector<std::string>*, std::vector<double>*,
    std::vector<int>*, std::vector<std::filesystem::path>*, Stage*, ViewSpec*, SizeTarget>;

struct Option
{
  std::string Key;   ///< in JSON, "hullSpacing"; on the command line "--hull-spacing"
  std::string Help;  ///< what it does, without unit, default and range
  std::string Unit;  ///< "px", "deg", ..; empty = none
  std::string Group; ///< heading in the help
  OptionTarget Target;
  double Least = -std::numeric_limits<double>::infinity();
  double Most = std::numeric_limits<double>::infinity();
  std::vector<std::string> Choices = {}; ///< of a text; empty = any
  bool InJob = true; ///< false: cannot change the result, so it is read from jobs, not written
};
using OptionTable = std::vector<Option>;

/** "hullSpacing" as "--hull-spacing". */
std::string FlagOf(const std::string& key);

/** The value as text, e.g. for "default: .."; empty when there is none. */
std::string ValueText(const Option& option);

/** The range as text, "1 to 10", "at least 0", "hull, outline, full"; empty when there is none. */
std::string RangeText(const Option& option);

/**
 * Sets an option from words of a command line; a list takes all of them. Throws UsageError, naming
 * the flag.
 */
void SetFromText(const Option& option, const std::vector<std::string>& words);

/**
 * Sets options from a JSON object. Relative paths are relative to `folder`. Unknown keys (the
 * nearest known one is suggested), wrong types and values out of range throw UsageError, naming
 * `where` and the key.
 */
void SetFromJson(const OptionTable& table, const nlohmann::ordered_json& object,
  const std::filesystem::path& folder, const std::string& where);

/** All options that are part of a job. Paths are absolute, but for one inside `folder`. */
nlohmann::ordered_json ToJson(const OptionTable& table, const std::filesystem::path& folder);

/** The known word nearest to a misspelt one by edit distance; empty when none is near. */
std::string NearestWord(const std::string& word, const std::vector<std::string>& known);

/** Reads the JSON object of a job or a path of cameras. Throws UsageError. */
nlohmann::ordered_json ReadJsonObject(const std::filesystem::path& path);
}

#endif
