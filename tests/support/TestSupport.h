// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_TestSupport_h
#define novelview_TestSupport_h

#include "core/Error.h"
#include "support/Expect.h"
#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace novelview::testing_support
{
using support::ExpectError;
using support::TemporaryFolder;

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
}

#endif
