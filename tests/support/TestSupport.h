// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_TestSupport_h
#define novelview_TestSupport_h

#include "core/Error.h"
#include "core/ImageRef.h"
#include "support/Expect.h"
#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
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

/** Intersection over union of a mask with the truth, which has the same size. */
inline double IouOf(const Image<std::uint8_t>& mask, const Image<std::uint8_t>& truth)
{
  double both = 0;
  double either = 0;
  for (std::size_t i = 0; i < truth.Values.size(); ++i)
  {
    both += mask.Values[i] > 127 && truth.Values[i] > 127;
    either += mask.Values[i] > 127 || truth.Values[i] > 127;
  }
  return both / either;
}

/** Real data and the yardstick live beside the source; where they do not, tests are skipped. */
inline std::filesystem::path SharedFolder()
{
  const char* named = std::getenv("NOVELVIEW_SHARED");
  return named ? named : std::filesystem::path(NOVELVIEW_SOURCE_DIR) / ".." / "shared";
}
}

#endif
