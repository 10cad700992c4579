// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Options as tables: one row per option has its key, help, unit, range and the address of its
 * value. Unit and range of a method's option come from the kernels (Parameter.h), as its default
 * does. Reading and writing JSON, command-line options and --help all come from the same table.
 */
#ifndef novelview_Options_h
#define novelview_Options_h

#include "base/UsageError.h"
#include "core/Parameter.h"

#include <nlohmann/json.hpp>

#include <array>
#include <filesystem>
#include <functional>
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

/** What a path of an option becomes: itself, or relative to another folder. */
using PathMap = std::function<std::filesystem::path(const std::filesystem::path&)>;

/** A value of another type that is written as one word. */
struct WordTarget
{
  const char* TypeName; ///< in the help: "STAGE"
  std::string Range;    ///< its words, if they can be listed
  /** Throws UsageError, naming `where`, when the word is none. */
  std::function<void(const std::string& word, const std::string& where, const PathMap& paths)> Set;
  std::function<std::string(const PathMap& paths)> Get;
};

/** The address of the value of an option; the type determines what it accepts. */
using OptionTarget =
  std::variant<bool*, int*, double*, std::string*, std::filesystem::path*, std::optional<double>*,
    std::optional<std::array<double, 6>>*, std::vector<std::string>*, std::vector<double>*,
    std::vector<int>*, std::vector<std::filesystem::path>*, WordTarget, SizeTarget>;

/** No limit of an option's range. */
constexpr double Unlimited = std::numeric_limits<double>::infinity();

struct Option
{
  std::string Key;   ///< in JSON, "hullSpacing"; on the command line "--hull-spacing"
  std::string Help;  ///< what it does, without unit, default and range
  std::string Unit;  ///< "px", "deg", ..; empty = none
  std::string Group; ///< heading in the help
  OptionTarget Target;
  double Min = -Unlimited;
  double Max = Unlimited;
  std::vector<std::string> Choices = {}; ///< of a text; empty = any
  bool InJob = true;   ///< false: cannot change the result, so it is read from jobs, not written
  bool OfScene = true; ///< false: does not matter before there is a novel camera, nor to the cache
  bool Positional = false;                  ///< on the command line a word without flag
  std::vector<std::string> FormerKeys = {}; ///< of earlier versions; still read, with a warning
};
using OptionTable = std::vector<Option>;

/** An option with the unit and the range of a parameter. */
template <class T>
Option ParameterOption(const std::string& key, const std::string& help, const std::string& group,
  T* target, const Parameter<T>& parameter)
{
  return { key, help, parameter.Unit, group, target, static_cast<double>(parameter.Min),
    static_cast<double>(parameter.Max) };
}

/** Words of a command line by the key of their option, in the order given. */
using ParsedArguments = std::vector<std::pair<std::string, std::vector<std::string>>>;

/** Receives a warning about former names of options, one line each. */
using OptionWarning = std::function<void(const std::string& text)>;

void AppendOptions(OptionTable& table, OptionTable more);

/** The option of a key, or a former one. Throws UsageError, naming the flag, when there is none. */
const Option& FindOption(const OptionTable& table, const std::string& key);

/** "hullSpacing" as "--hull-spacing". */
std::string FlagOf(const std::string& key);

/** The value as text, e.g. for "default: .."; empty when there is none. */
std::string ValueText(const Option& option);

/** The range as text, "1 to 10", "at least 0", "hull, outline, full"; empty when there is none. */
std::string RangeText(const Option& option);

/**
 * Throws UsageError, naming `where` and the key, when a value is out of the range or none of the
 * choices of its option: for options that were set by a program.
 */
void CheckValues(const OptionTable& table, const std::string& where);

/**
 * Sets an option from words of a command line; a list takes all of them. Throws UsageError, naming
 * the flag.
 */
void SetFromText(const Option& option, const std::vector<std::string>& words);

/**
 * Sets the options that were given. Throws UsageError, naming the flag, also when an option is given
 * by its key and a former one.
 */
void SetFromArguments(
  const OptionTable& table, const ParsedArguments& given, const OptionWarning& warn = {});

/**
 * Sets options from a JSON object. Relative paths are relative to `folder`. Unknown keys (the
 * nearest known one is suggested), a key beside a former one of the same option, wrong types and
 * values out of range throw UsageError, naming `where` and the key.
 */
void SetFromJson(const OptionTable& table, const nlohmann::ordered_json& object,
  const std::filesystem::path& folder, const std::string& where, const OptionWarning& warn = {});

/** All options that are part of a job. Paths are absolute, except those inside `folder`. */
nlohmann::ordered_json ToJson(const OptionTable& table, const std::filesystem::path& folder);

/** Reads the JSON object of a job or a path of cameras. Throws UsageError. */
nlohmann::ordered_json ReadJsonObject(const std::filesystem::path& path);
}

#endif
