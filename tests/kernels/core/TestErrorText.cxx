// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/Error.h"
#include "core/PrintableText.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <new>
#include <random>
#include <system_error>

using namespace novelview;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

TEST(ErrorText, ShortPartsStayAsTheyAre)
{
  EXPECT_STREQ(Error("view 3 (b.png)", "mask is too small", "64x48", "640x480").what(),
    "view 3 (b.png): mask is too small (got 64x48, expected 640x480)");
  EXPECT_STREQ(Error("a", "b").what(), "a: b");
}

TEST(ErrorText, WordsOfTenMegabytesAreCutInTheMiddle)
{
  const std::string text = Error("folder/data_par.txt, line 1", "value 1 is not a number",
    std::string(10000000, 'a'), "a number")
                             .what();
  EXPECT_EQ(text.size(), MaxInLine);
  EXPECT_THAT(text, StartsWith("folder/data_par.txt, line 1: value 1 is not a number (got aaa"));
  EXPECT_THAT(text, HasSubstr("..."));
  EXPECT_THAT(text, EndsWith("aaa, expected a number)"));
}

TEST(ErrorText, LongPathsKeepTheirEnd)
{
  const std::string path = "/" + std::string(2000, 'd') + "/bunny_par.txt, line 4";
  const std::string text = Error(path, "calibration line is short", "20 values", "21").what();
  EXPECT_EQ(text.size(), MaxInLine);
  EXPECT_THAT(text, StartsWith("/ddd"));
  EXPECT_THAT(text,
    HasSubstr("ddd/bunny_par.txt, line 4: calibration line is short (got 20 values, expected 21)"));
}

TEST(ErrorText, EveryLongPartKeepsAShare)
{
  const std::string text = Error("w" + std::string(999, '.'), "x" + std::string(999, '.'),
    "y" + std::string(999, '.'), "z" + std::string(999, '.'))
                             .what();
  EXPECT_LE(text.size(), MaxInLine);
  for (const char* part : { "w....", ": x....", " (got y....", ", expected z...." })
  {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(ErrorText, ControlCharactersAndBytesThatAreNoUtf8AreWrittenOut)
{
  EXPECT_STREQ(Error("caf\xE9", "a\nb\tc\x1B[31m\x7F").what(), "caf\\xE9: a b c\\x1B[31m\\x7F");
  EXPECT_EQ(Printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(Printable("caf\xC3\xA9 \xE2\x82\xAC"), "caf\xC3\xA9 \xE2\x82\xAC");
  // A surrogate, a long form of '/', a character cut off, and one that turns the writing round.
  EXPECT_EQ(Printable("\xED\xA0\x80"), "\\xED\\xA0\\x80");
  EXPECT_EQ(Printable("\xC0\xAF"), "\\xC0\\xAF");
  EXPECT_EQ(Printable("a\xE2\x82"), "a\\xE2\\x82");
  EXPECT_EQ(Printable("\xE2\x80\xAE"), "\\xE2\\x80\\xAE");
}

TEST(ErrorText, CutsLieBetweenCharacters)
{
  std::string text;
  for (int i = 0; i < 400; ++i)
  {
    text += "\xE2\x82\xAC";
  }
  for (std::size_t most = 3; most < 40; ++most)
  {
    const std::string cut = Shortened(text, most);
    EXPECT_LE(cut.size(), most);
    EXPECT_TRUE(IsUtf8(cut)) << cut;
  }
}

TEST(ErrorText, AnyBytesGiveOneLineOfUtf8)
{
  std::mt19937 random(7);
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<int> length(0, 2000);
  for (int round = 0; round < 300; ++round)
  {
    std::string parts[4];
    for (std::string& part : parts)
    {
      part.resize(static_cast<std::size_t>(length(random)));
      std::generate(part.begin(), part.end(), [&] { return static_cast<char>(byte(random)); });
    }
    const std::string text = Error(parts[0], parts[1], parts[2], parts[3]).what();
    EXPECT_LE(text.size(), MaxInLine);
    EXPECT_TRUE(IsUtf8(text));
    EXPECT_EQ(text.find_first_of(std::string("\0\n\r\t\x1B", 5)), std::string::npos);
  }
}

TEST(ErrorText, ExceptionsOfLibrariesAreToldInOwnWords)
{
  EXPECT_EQ(ErrorText(Error("a", "b")), "a: b");
  EXPECT_THAT(ErrorText(std::bad_alloc()), StartsWith("out of memory: "));
  const std::filesystem::filesystem_error file(
    "cannot do", "some/caf\xE9", std::make_error_code(std::errc::permission_denied));
  EXPECT_EQ(ErrorText(file), "some/caf\\xE9: Permission denied");
  EXPECT_EQ(ErrorText(std::system_error(std::make_error_code(std::errc::too_many_files_open), "x")),
    "the system refuses something: Too many open files");
  EXPECT_THAT(
    ErrorText(std::length_error("basic_string::_M_create")), StartsWith("internal error"));
}
