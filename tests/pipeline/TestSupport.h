// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_TestSupport_h
#define novelview_TestSupport_h

#include "Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>
#include <vector>

namespace novelview::testing_support
{
/** A folder of its own that goes away with the test. */
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "novelview-XXXXXX").string();
    if (!::mkdtemp(name.data()))
    {
      throw Error(name, "cannot make a temporary folder");
    }
    this->Path = name;
  }
  ~TemporaryFolder()
  {
    std::error_code failure;
    std::filesystem::remove_all(this->Path, failure);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return this->Path / name; }

  std::filesystem::path Path;
};

inline void WriteText(const std::filesystem::path& path, const std::string& text)
{
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string ReadText(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

/** Real data and the yardstick live beside the source; where they do not, tests are skipped. */
inline std::filesystem::path SharedFolder()
{
  const char* named = std::getenv("NOVELVIEW_SHARED");
  return named ? named : std::filesystem::path(NOVELVIEW_SOURCE_DIR) / ".." / "shared";
}

/** Expects the message of the Error that `body` throws to hold every one of `parts`. */
template <class Body, class... Parts>
void ExpectError(const Body& body, const Parts&... expected)
{
  const std::vector<std::string> parts{ expected... };
  try
  {
    body();
    ADD_FAILURE() << "no error, expected one with: " << ::testing::PrintToString(parts);
  }
  catch (const Error& error)
  {
    const std::string text = error.what();
    for (const std::string& part : parts)
    {
      EXPECT_THAT(text, ::testing::HasSubstr(part));
    }
    EXPECT_EQ(text.find('\n'), std::string::npos) << "more than one line: " << text;
  }
}
}

#endif
