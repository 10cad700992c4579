// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/OpenCvStorage.h"

#include "support/TestSupport.h"

#include <opencv2/core.hpp>

#include <random>

using namespace novelview;
using namespace novelview::testing_support;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace
{
std::string Repeated(const std::string& text, int times)
{
  std::string all;
  for (int i = 0; i < times; ++i)
  {
    all += text;
  }
  return all;
}

StorageNode Parsed(const std::string& text)
{
  return ParseOpenCvStorage(text, "c.yml");
}

template <class... Parts>
void ExpectRefused(const std::string& text, const Parts&... parts)
{
  ExpectError([&text] { Parsed(text).Numbers("c.yml"); }, "c.yml", parts...);
}

std::string YamlMatrix(const std::string& dt, const std::string& data)
{
  return "%YAML:1.0\n---\nm: !!opencv-matrix\n   rows: 2\n   cols: 2\n   dt: " + dt +
    "\n   data: [ " + data + " ]\n";
}

std::vector<double> NumbersOf(const std::string& text)
{
  return Parsed(text)["m"].Numbers("m");
}

/** What OpenCV writes of a matrix, in an encoding. */
std::string Written(const cv::Mat& matrix, const std::string& extension)
{
  cv::FileStorage storage("x" + extension, cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  storage << "m" << matrix << "s"
          << "it's a \"text\" \\ 5"
          << "n" << -0.1 << "i" << 7;
  return storage.releaseAndGetString();
}
}

TEST(OpenCvStorage, WhatOpenCvWritesReadsBackToTheSameBits)
{
  cv::Mat matrix(5, 40, CV_64F);
  cv::RNG random(5);
  for (double& number : cv::Mat_<double>(matrix))
  {
    number = random.gaussian(1) * std::pow(10.0, random.uniform(-30, 30));
  }
  matrix.at<double>(0, 0) = 500;
  matrix.at<double>(0, 1) = 5e-324;
  for (const int type : { CV_64F, CV_32F })
  {
    cv::Mat typed;
    matrix.convertTo(typed, type);
    cv::Mat expected;
    typed.convertTo(expected, CV_64F);
    for (const char* extension : { ".yml", ".xml", ".json" })
    {
      const StorageNode root = Parsed(Written(typed, extension));
      const std::vector<double> numbers = root["m"].Numbers("m");
      ASSERT_EQ(numbers.size(), expected.total());
      EXPECT_EQ(std::memcmp(numbers.data(), expected.data, 8 * numbers.size()), 0) << extension;
      EXPECT_EQ(root["n"].Number, -0.1);
      EXPECT_EQ(root["i"].Number, 7);
    }
  }
  EXPECT_EQ(Parsed(Written(matrix, ".yml"))["s"].Text, "it's a \"text\" \\ 5");
  EXPECT_EQ(Parsed(Written(matrix, ".json"))["s"].Text, "it's a \"text\" \\ 5");
}

TEST(OpenCvStorage, IntegersOfMatricesAreRounded)
{
  EXPECT_THAT(
    NumbersOf(YamlMatrix("i", "1, 2.6, -3.5, 3000000000")), ElementsAre(1, 3, -4, 2147483647));
  EXPECT_THAT(NumbersOf(YamlMatrix("u", "1, 2, -3, 300")), ElementsAre(1, 2, 0, 255));
  EXPECT_THAT(NumbersOf(YamlMatrix("f", "0.1, 0, 0, 0")), ElementsAre(0.1f, 0, 0, 0));
  EXPECT_THAT(
    NumbersOf(YamlMatrix("2d", "1, 2, 3, 4, 5, 6, 7, 8")), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
}

TEST(OpenCvStorage, CommasBetweenNumbersMayBeMissing)
{
  EXPECT_THAT(NumbersOf("m: [ 1 2. .5 1e1 ]"), ElementsAre(1, 2, .5, 10));
  EXPECT_THAT(NumbersOf("<opencv_storage><m>1, 2 +3</m></opencv_storage>"), ElementsAre(1, 2, 3));
  EXPECT_THAT(NumbersOf(YamlMatrix("d", "1 2 3 4")), ElementsAre(1, 2, 3, 4));
}

TEST(OpenCvStorage, XmlTellsTextsListsAndMaps)
{
  const StorageNode root = Parsed("<?xml version=\"1.0\"?>\n<!-- a --><opencv_storage>\n"
                                  "<one>a.png</one><two>a.png \"b c.png\" 5 \"5\"</two><none/>"
                                  "<list><_>1</_></list><map><x>1</x><y>&lt;</y></map>"
                                  "</opencv_storage>");
  EXPECT_EQ(root["one"].Text, "a.png");
  ASSERT_EQ(root["two"].Items.size(), 4u);
  EXPECT_EQ(root["two"].Items[1].Text, "b c.png");
  EXPECT_EQ(root["two"].Items[2].What, StorageNode::Kind::Number);
  EXPECT_TRUE(root["two"].Items[3].IsText());
  EXPECT_TRUE(root["none"].IsNone());
  EXPECT_TRUE(root["nothing"].IsNone());
  EXPECT_TRUE(root["list"].IsList());
  EXPECT_EQ(root["map"]["y"].Text, "<");
}

TEST(OpenCvStorage, WordsThatBeginLikeNumbersAreTexts)
{
  const StorageNode root = Parsed("a: 0001.png\nb: \"5\"\nc: -.Inf\nd: nan\ne: ''\n");
  EXPECT_EQ(root["a"].Text, "0001.png");
  EXPECT_TRUE(root["a"].IsText());
  EXPECT_TRUE(root["b"].IsText());
  EXPECT_EQ(root["c"].Number, -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(root["d"].IsText());
  EXPECT_TRUE(root["e"].IsText());
}

TEST(OpenCvStorage, XmlCutAnywhereIsRefused)
{
  const std::string whole = Written(cv::Mat::eye(3, 3, CV_64F), ".xml");
  for (std::size_t length = 1; length + 2 < whole.size(); ++length)
  {
    EXPECT_THROW(Parsed(whole.substr(0, length)), Error) << length;
  }
  ExpectRefused(whole.substr(0, whole.size() / 2), "line ", "not valid XML");
}

TEST(OpenCvStorage, NestingFiftyThousandDeepIsAnErrorAndNoCrash)
{
  const int many = 50000;
  ExpectRefused("%YAML:1.0\n---\na: " + Repeated("[", many), "line 3", "nested too deep");
  ExpectRefused(Repeated("- ", many), "nested too deep");
  ExpectRefused(Repeated("? ", many), "nested too deep");
  ExpectRefused(Repeated("{a: ", many), "nested too deep");
  ExpectRefused(
    "<opencv_storage>" + Repeated("<a>", many) + Repeated("</a>", many) + "</opencv_storage>",
    "nested too deep");
  ExpectRefused("{\"a\":" + Repeated("[", many) + Repeated("]", many) + "}", "nested too deep");
}

TEST(OpenCvStorage, SlipsAreNamedByLineInTheProgramsWords)
{
  ExpectRefused("%YAML:1.0\n---\na: [ 1, 2\nb: 3\n", "line 4", "not valid YAML");
  ExpectRefused("%YAML:1.0\n---\na: &x 1\nb: *x\n", "line 3", "anchors and aliases");
  ExpectRefused("{\"a\": }", "line 1, column 7", "is not JSON");
  ExpectRefused("<storage/>", "got element \"storage\", expected \"opencv_storage\"");
  ExpectRefused("<opencv_storage><a>1<b>2</b></a></opencv_storage>", "line 1", "\"a\" mixes");
  ExpectRefused("a: caf\xE9", "not UTF-8");
  const auto refused = [](const std::string& text, const auto&... parts)
  { ExpectError([&text] { NumbersOf(text); }, "m: ", parts...); };
  refused(YamlMatrix("d", "1, 2, 3"), "not have its stated size", "got 3 numbers, expected 4");
  refused(YamlMatrix("q", "1, 2, 3, 4"), "no \"dt\"", "got q");
  refused(YamlMatrix("d", "1, 2, x, 4"), "is not a number", "'x'");
  refused("m: !!opencv-matrix\n   dt: d\n", "no \"rows\"");
  refused("m: !!opencv-matrix\n   dt: d\n   rows: 1e300\n   cols: 1e300\n   data: []\n",
    "not have its stated size");
}

TEST(OpenCvStorage, AnyChangeOfAFileIsReadOrRefused)
{
  std::mt19937 random(11);
  const auto below = [&random](std::size_t count)
  { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random); };
  const std::string signs = "{}[]<>/\"':,-?&*!%#|\\0e.\n\t \xE9";
  for (const char* extension : { ".yml", ".xml", ".json" })
  {
    const std::string good = Written(cv::Mat::eye(2, 3, CV_64F), extension);
    for (int round = 0; round < 4000; ++round)
    {
      std::string text = good;
      for (std::size_t change = 0; change <= below(4); ++change)
      {
        const std::size_t at = below(text.size());
        if (below(2) == 0)
        {
          text[at] = signs[below(signs.size())];
        }
        else
        {
          text.replace(at, below(8), text.substr(below(text.size()), below(40)));
        }
      }
      try
      {
        Parsed(text)["m"].Numbers("m");
      }
      catch (const Error& error)
      {
        EXPECT_THAT(error.what(), Not(HasSubstr("yaml-cpp")));
        EXPECT_THAT(error.what(), Not(HasSubstr("exception")));
      }
    }
  }
}
