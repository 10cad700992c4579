// SPDX-License-Identifier: GPL-3.0-or-later
/** What the fuzzers share. */
#ifndef fuzz_FuzzSupport_h
#define fuzz_FuzzSupport_h

#include "core/Error.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace fuzz
{
/** Separates the files of an input that stands for several. */
inline constexpr std::string_view FileMark = "\n=====\n";

/** Ends the program, which the fuzzer reports. */
[[noreturn]] inline void Fail(const std::string& why)
{
  std::fprintf(stderr, "fuzz: %s\n", why.c_str());
  std::abort();
}

/**
 * Runs `body`, which may throw an Error of one line in the program's own words and those of the input,
 * and nothing else.
 */
template <class Body>
void ExpectOnlyErrors(std::string_view input, const Body& body)
{
  try
  {
    body();
  }
  catch (const novelview::Error& error)
  {
    const std::string text = error.what();
    if (text.find('\n') != std::string::npos)
    {
      Fail("the message of an error has several lines: " + text);
    }
    for (const char* foreign : { "[json.exception", "OpenCV(", "std::bad_alloc", "basic_string" })
    {
      // The fuzzer finds these words, too, and puts them into its files, which messages quote.
      if (text.find(foreign) != std::string::npos && input.find(foreign) == std::string_view::npos)
      {
        Fail("the message of an error holds another's words: " + text);
      }
    }
    if (text.size() > 4096)
    {
      Fail("the message of an error is " + std::to_string(text.size()) + " characters long");
    }
  }
}

/** A folder of this process; tests/fuzz.sh sets TMPDIR and clears it. */
inline const std::filesystem::path& ScratchFolder()
{
  static const std::filesystem::path folder = []
  {
    const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(::getpid()));
    std::filesystem::create_directories(path);
    return path;
  }();
  return folder;
}

inline void WriteFile(const std::filesystem::path& file, std::string_view bytes)
{
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary)
    .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/** The parts between file marks. */
inline std::vector<std::string_view> Files(std::string_view bytes)
{
  std::vector<std::string_view> files;
  for (std::size_t end = 0; end != std::string_view::npos;)
  {
    end = bytes.find(FileMark);
    files.push_back(bytes.substr(0, end));
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + FileMark.size());
  }
  return files;
}
}

#endif
