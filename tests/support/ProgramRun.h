// SPDX-License-Identifier: GPL-3.0-or-later
/** Running the built program in its own process, and reading what it leaves behind. */
#ifndef novelview_tests_ProgramRun_h
#define novelview_tests_ProgramRun_h

#include "support/TestSupport.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <vector>

namespace novelview::testing_support
{
/** The end of a process. */
struct ProcessEnd
{
  int Code = -1; ///< exit code; -1 when a signal ended it
  std::string Out;
  std::string Err;
};

inline std::string ShellQuoted(const std::string& word)
{
  return "'" + word + "'";
}

/** Runs a command of the shell. */
inline ProcessEnd RunShell(const std::string& command)
{
  const TemporaryFolder folder;
  const int status = std::system(("{ " + command + "\n} >" +
    ShellQuoted((folder / "out").string()) + " 2>" + ShellQuoted((folder / "err").string()))
                                   .c_str());
  ProcessEnd end;
  // The shell itself says 128 + n when signal n ended the program.
  end.Code = WIFEXITED(status) && WEXITSTATUS(status) != 128 + SIGSEGV &&
      WEXITSTATUS(status) != 128 + SIGABRT
    ? WEXITSTATUS(status)
    : -1;
  end.Out = ReadText(folder / "out");
  end.Err = ReadText(folder / "err");
  return end;
}

/** Runs the program with these words. */
inline ProcessEnd RunProgram(const std::vector<std::string>& words)
{
  std::string command = ShellQuoted(NOVELVIEW_PROGRAM);
  for (const std::string& word : words)
  {
    command += " " + ShellQuoted(word);
  }
  return RunShell(command);
}

/** The same, where anything but success ends the test. */
inline void MustRun(const std::vector<std::string>& words)
{
  const ProcessEnd end = RunProgram(words);
  if (end.Code != 0)
  {
    throw Error(
      ::testing::PrintToString(words), "ended with " + std::to_string(end.Code) + ": " + end.Err);
  }
}

inline std::vector<std::string> With(
  std::vector<std::string> words, const std::vector<std::string>& more)
{
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

inline nlohmann::json ReadJson(const std::filesystem::path& path)
{
  return nlohmann::json::parse(ReadText(path));
}

/** A number of summary.json: stage "hull", "outline", "full" or "oracle", name "rms", "ssim" .. */
inline double ScoreIn(
  const std::filesystem::path& out, const std::string& stage, const std::string& name)
{
  return ReadJson(out / "summary.json").at("stages").at(stage).at(name).get<double>();
}

/** Content of every file below a folder, by its path in it. */
inline std::map<std::string, std::string> FilesBelow(const std::filesystem::path& folder)
{
  std::map<std::string, std::string> files;
  if (std::filesystem::exists(folder))
  {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    {
      if (entry.is_regular_file())
      {
        files[entry.path().lexically_relative(folder).string()] = ReadText(entry.path());
      }
    }
  }
  return files;
}

/** Names of what WriteAtomically() has not finished: hidden files. */
inline std::vector<std::string> HalfWritten(const std::filesystem::path& folder)
{
  std::vector<std::string> names;
  for (const auto& [name, content] : FilesBelow(folder))
  {
    if (std::filesystem::path(name).filename().string().front() == '.')
    {
      names.push_back(name);
    }
  }
  return names;
}

/** A page of a report without its section and its data about how long everything took. */
inline std::string WithoutTimings(std::string page)
{
  const std::pair<const char*, const char*> parts[] = {
    { "<section id=\"timings\">", "</section>" }, { "\"timings\": {", "</script>" }
  };
  for (const auto& [begin, end] : parts)
  {
    const std::size_t from = page.find(begin);
    const std::size_t to = page.find(end, from);
    if (from == std::string::npos || to == std::string::npos)
    {
      throw Error("report", std::string("has no ") + begin);
    }
    page.erase(from, to - from);
  }
  return page;
}

/**
 * Expects two folders to hold the same files with the same bytes; of report.html all but what it
 * says about how long everything took.
 */
inline void ExpectSameFiles(const std::filesystem::path& a, const std::filesystem::path& b)
{
  const auto filesA = FilesBelow(a);
  const auto filesB = FilesBelow(b);
  EXPECT_FALSE(filesA.empty());
  for (const auto& [name, content] : filesA)
  {
    const auto other = filesB.find(name);
    ASSERT_NE(other, filesB.end()) << name << " is missing in " << b;
    const bool same = name == "report.html"
      ? WithoutTimings(content) == WithoutTimings(other->second)
      : content == other->second;
    EXPECT_TRUE(same) << name << " differs";
  }
  EXPECT_EQ(filesA.size(), filesB.size());
}

/** A table: column by name. Empty cells are NaN. */
inline std::map<std::string, std::vector<double>> ReadTable(const std::filesystem::path& path)
{
  const auto cells = [](const std::string& line)
  {
    std::vector<std::string> words;
    std::istringstream stream(line);
    for (std::string word; std::getline(stream, word, ',');)
    {
      words.push_back(word);
    }
    return words;
  };
  std::istringstream text(ReadText(path));
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> names = cells(line);
  std::map<std::string, std::vector<double>> table;
  while (std::getline(text, line))
  {
    const std::vector<std::string> words = cells(line);
    if (words.size() != names.size())
    {
      throw Error(path.string(), "ragged line: " + line);
    }
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      table[names[i]].push_back(words[i].empty() ? std::nan("") : std::stod(words[i]));
    }
  }
  return table;
}

/** A generated data set for all tests of a suite; goes away with the process. */
class GeneratedData
{
public:
  explicit GeneratedData(const std::vector<std::string>& options)
  {
    MustRun(With(
      { "generate", "--quiet", "--out", this->Data().string(), "--supersampling", "2" }, options));
  }
  std::filesystem::path Data() const { return this->Folder / "data"; }
  std::string HeldOut(int view = 0) const
  {
    return "file:" + (this->Data() / "test" / "test_par.txt").string() + "#test000" +
      std::to_string(view) + ".png";
  }

  TemporaryFolder Folder;
};
}

#endif
