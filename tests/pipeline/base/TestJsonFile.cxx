// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/JsonFile.h"

#include "core/PrintableText.h"
#include "options/Options.h"
#include "support/TestSupport.h"

#include <random>
#include <sys/stat.h>

using namespace novelview;
using namespace novelview::testing_support;
using testing::HasSubstr;
using testing::Not;

namespace
{
/** Expects an error with these parts and no word of the JSON library's. */
template <class... Parts>
void ExpectRefused(const std::string& text, const Parts&... parts)
{
  ExpectError([&text] { ParseJson(text, "job.json"); }, "job.json", parts...);
  try
  {
    ParseJson(text, "job.json");
  }
  catch (const Error& error)
  {
    EXPECT_THAT(error.what(), Not(HasSubstr("json.exception")));
    EXPECT_THAT(error.what(), Not(HasSubstr("syntax")));
  }
}

std::string Nested(int levels)
{
  const auto count = static_cast<std::size_t>(levels);
  return R"({"a": )" + std::string(count, '[') + std::string(count, ']') + "}";
}
}

TEST(JsonFile, ValuesAreThoseOfTheText)
{
  const auto value = ParseJson("\n{ \"b\": [1, -2.5e3, true, null], \"a\": \"\\u00e9\" } ", "x");
  EXPECT_EQ(value.dump(), "{\"b\":[1,-2500.0,true,null],\"a\":\"\xC3\xA9\"}");
  EXPECT_EQ(ParseJson("0.1", "x").get<double>(), 0.1);
}

TEST(JsonFile, SlipsAreNamedByLineAndColumnAndWhatWasExpected)
{
  ExpectRefused("", "line 1, column 1: is not JSON", "got the end, expected a value");
  ExpectRefused("{", "line 1, column 2", "got the end, expected a key in quotes or '}'");
  ExpectRefused("{\n  \"a\": 1,\n}", "line 3, column 1", "got '}', expected a key in quotes");
  ExpectRefused("{\"a\" 1}", "line 1, column 6", "got '1', expected ':' and a value");
  ExpectRefused("{\"a\": }", "column 7", "got '}', expected a value");
  ExpectRefused("{\"a\": 1 \"b\"", "column 9", "expected ',' or '}'");
  ExpectRefused("[1, 2", "column 6", "got the end, expected ',' or ']'");
  ExpectRefused("[1,]", "column 4", "got ']', expected a value");
  ExpectRefused("[yes]", "column 2", "got 'y", "expected a value or ']'");
  ExpectRefused("{} x", "column 4", "got 'x', expected the end");
  ExpectRefused("[1e999]", "column 2: number is out of range", "got '1e999'");
  ExpectRefused("[\n\"a\nb\"]", "line 2, column 1: is not JSON");
}

TEST(JsonFile, AKeyThatIsThereTwiceIsNamed)
{
  ExpectRefused(R"({"a": 1, "a": 2})", "key \"a\" is there twice");
  ExpectRefused(R"([{"b": {"a": 1, "a": 2}}])", "key \"a\" is there twice");
  EXPECT_NO_THROW(ParseJson(R"({"a": {"a": [{"a": 1}, {"a": 2}]}})", "x"));
}

TEST(JsonFile, NestingAHundredThousandDeepIsAnErrorAndNoCrash)
{
  ExpectRefused(Nested(100000), "line 1, column 70: JSON is nested too deep");
  ExpectRefused(Nested(MaxJsonNesting), "nested too deep");
  const auto deepest = ParseJson(Nested(MaxJsonNesting - 1), "x");
  EXPECT_EQ(DumpJson(deepest, -1).size(), Nested(MaxJsonNesting - 1).size() - 1);
  // Brackets in texts are no nesting.
  EXPECT_NO_THROW(ParseJson("[\"" + std::string(1000, '[') + "\\\"" + "[\"]", "x"));
}

TEST(JsonFile, TextThatIsNoUtf8IsNamedByItsPlace)
{
  ExpectRefused("{\n\"caf\xE9\": 1}", "line 2, column 5: is not JSON: its text is not UTF-8");
}

TEST(JsonFile, WritingNeverThrows)
{
  EXPECT_EQ(DumpJson("caf\xE9", -1), "\"caf\xEF\xBF\xBD\"");
  EXPECT_EQ(DumpJson(std::nan(""), -1), "null");
  EXPECT_EQ(DumpJson({ { "a", 1 } }), "{\n  \"a\": 1\n}");
  EXPECT_EQ(JsonTypeText("2"), "string \"2\"");
  EXPECT_LE(JsonTypeText(std::string(10000000, 'x')).size(), 50u);
}

TEST(JsonFile, WholeNumbersThatNoIntHoldsAreOutOfRange)
{
  int number = 7;
  const OptionTable table{ { "n", "", "", "", &number } };
  for (const char* text : { "18446744073709551615", "2147483648", "-2147483649" })
  {
    ExpectError([&]
      { SetFromJson(table, ParseJson("{\"n\":" + std::string(text) + "}", "x"), {}, "x"); },
      "key \"n\"", text, "32 bits");
  }
  SetFromJson(table, ParseJson(R"({"n": -2147483648})", "x"), {}, "x");
  EXPECT_EQ(number, std::numeric_limits<int>::min());
}

TEST(JsonFile, PipesAndFoldersAreRefusedAtOnce)
{
  const TemporaryFolder folder;
  const auto pipe = folder / "pipe.json";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  ExpectError([&] { ReadJsonFile(pipe); }, "pipe.json", "is not a regular file");
  ExpectError([&] { ReadJsonFile(folder.Path); }, "is not a regular file");
  ExpectError([&] { ReadJsonFile(folder / "nothing.json"); }, "no such file");
  EXPECT_THROW(ReadJsonObject(folder / "nothing.json"), UsageError);
}

TEST(JsonFile, AnyChangeOfAFileIsReadOrRefused)
{
  const std::string good = R"({"dataset": "a", "hullBox": [0, -1.5e0, 2, 3, 4, 5], "x": {"y": null,
    "z": "\u00e9\"\\", "lit": [true, false]}})";
  std::mt19937 random(3);
  const auto below = [&random](std::size_t count)
  { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random); };
  const std::string signs = "{}[]\",:\\0e-+.\n \xE9\xC3";
  for (int round = 0; round < 20000; ++round)
  {
    std::string text = good;
    for (std::size_t change = 0; change <= below(4); ++change)
    {
      const std::size_t at = below(text.size());
      switch (below(4))
      {
        case 0:
          text[at] = signs[below(signs.size())];
          break;
        case 1:
          text.erase(at, 1 + below(5));
          break;
        case 2:
          text.insert(at, 1, signs[below(signs.size())]);
          break;
        default:
          text.insert(at, text.substr(below(text.size()), below(30)));
      }
    }
    try
    {
      ParseJson(text, "job.json");
    }
    catch (const Error& error)
    {
      EXPECT_TRUE(IsUtf8(error.what())) << text;
    }
  }
}
