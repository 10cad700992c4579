// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/SuggestedCommand.h"

#include <filesystem>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
/** A word of a shell's command line. */
std::string ShellWord(const std::string& word)
{
  const bool plain = !word.empty() &&
    word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                           "_-+=./,:@%") == std::string::npos;
  if (plain)
  {
    return word;
  }
  std::string quoted = "'";
  for (const char c : word)
  {
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return quoted + "'";
}
}

std::string SuggestedCommand(const DatasetInput& input, const std::string& name,
  const std::vector<std::string>& words, const std::string& formatFlag)
{
  std::string command = "novelview " + name + " " + ShellWord(input.Dataset.string());
  for (const std::string& word : words)
  {
    command += " " + ShellWord(word);
  }
  if (!input.Source.Calibration.empty())
  {
    command += " --calibration " + ShellWord(input.Source.Calibration.string());
  }
  if (input.Source.Format != "auto")
  {
    command += " " + formatFlag + " " + input.Source.Format;
  }
  return command;
}

std::string ConvertCommand(
  const DatasetInput& input, const std::string& format, const std::vector<std::string>& options)
{
  fs::path folder = input.Dataset.lexically_normal();
  folder = folder.has_filename() ? folder : folder.parent_path();
  std::vector<std::string> words = { folder.string() + "-mended", "--format", format };
  words.insert(words.end(), options.begin(), options.end());
  return SuggestedCommand(input, "convert", words, "--from");
}
}
