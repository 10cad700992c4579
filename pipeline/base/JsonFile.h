// SPDX-License-Identifier: GPL-3.0-or-later
/** JSON in and out: one way for all files, with errors in the program's words. */
#ifndef novelview_JsonFile_h
#define novelview_JsonFile_h

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace novelview
{
/** Objects and arrays may be nested so deep. */
constexpr int MaxJsonNesting = 64;

/**
 * A JSON value from its text. Throws Error, naming `where`, line and column, and what was expected
 * there; also when it is nested too deep, is not UTF-8, or an object has a key twice.
 */
nlohmann::ordered_json ParseJson(const std::string& text, const std::string& where);

/** The same from a file; see ReadInputFile(). */
nlohmann::ordered_json ReadJsonFile(const std::filesystem::path& path);

/**
 * The text of a value, with lines when `indent` is not negative. Never throws: bytes that are no
 * UTF-8 become U+FFFD, numbers that are not finite null.
 */
std::string DumpJson(const nlohmann::ordered_json& value, int indent = 2);

/** A value in a message: its type and the beginning of its text. */
std::string JsonTypeText(const nlohmann::ordered_json& value);
}

#endif
