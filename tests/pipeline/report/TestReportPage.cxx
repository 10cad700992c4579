// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/ReportPage.h"
#include "support/TestSupport.h"

using namespace novelview;
using namespace novelview::testing_support;
using testing::HasSubstr;

namespace
{
/** What stands between two texts. */
std::string Between(const std::string& text, const std::string& begin, const std::string& end)
{
  const std::size_t from = text.find(begin) + begin.size();
  return text.substr(from, text.find(end, from) - from);
}

const std::string DataBegin = "<script type=\"application/json\" id=\"report-data\">";
}

TEST(ReportPage, TextsAreEscapedEverywhere)
{
  const std::string evil = "</title><script>x\"&{{data}}";
  const std::string safe = "&lt;/title&gt;&lt;script&gt;x&quot;&amp;{{data}}";
  ReportPage page(evil, evil);
  page.BeginSection("one", evil);
  page.AddText(evil);
  page.AddTiles({ { evil, evil } });
  page.AddTable({ "table", evil, { evil }, { { ReportCell(evil) } } });
  page.AddCharts({ { evil, evil, { { evil, { { 0, 1 }, { 1, 2 } } } }, { evil, evil } } });
  page.AddGallery({ { evil, evil, "data:,", 1, 1 } });
  page.AddJson("json", evil, { { "key", evil } });
  const std::string html = page.Html({ { "key", evil } });
  EXPECT_EQ(html.find("<script>x"), std::string::npos);
  EXPECT_THAT(html, HasSubstr("<h1>" + safe + "</h1>"));
  EXPECT_THAT(html, HasSubstr("<p>" + safe + "</p>"));
  // What users call their files must not be taken for a place of the template.
  EXPECT_EQ(Between(html, "<h1>", "</h1>"), safe);
}

TEST(ReportPage, DataReadBackAsTheyWere)
{
  const nlohmann::ordered_json data = { { "name", "</script><!--<b>" }, { "number", 0.1 } };
  const std::string block = Between(ReportPage("a", "b").Html(data), DataBegin, "</script>");
  EXPECT_EQ(block.find('<'), std::string::npos) << "nothing in it can end the script element";
  EXPECT_EQ(nlohmann::ordered_json::parse(block), data);
}

TEST(ReportPage, BytesThatAreNoUtf8AreReplaced)
{
  ReportPage page("caf\xe9.png", "");
  const std::string html = page.Html({ { "name", "caf\xe9.png" } });
  EXPECT_EQ(html.find('\xe9'), std::string::npos);
  EXPECT_THAT(html, HasSubstr("<h1>caf\xef\xbf\xbd.png</h1>"));
}

TEST(ReportPage, NumbersOfTablesKeepEveryDigit)
{
  ReportPage page("a", "b");
  page.AddTable({ "t", "", { "x" }, { { ReportCell(0.1 + 0.2, "%.2f") } } });
  EXPECT_THAT(page.Html({}),
    HasSubstr("data-value=\"0.30000000000000004\" title=\"0.30000000000000004\">0.30<"));
}

TEST(ReportPage, PicturesAreScaledDownAndNeverUp)
{
  const Image<std::uint8_t> pixels(40, 20, 3, 200);
  const ReportPicture small = EmbedPicture("a", "b", pixels.Ref(), 10);
  EXPECT_EQ(small.Width, 10);
  EXPECT_EQ(small.Height, 5);
  const ReportPicture same = EmbedPicture("a", "b", pixels.Ref(), 100);
  EXPECT_EQ(same.Width, 40);
  // "/9j/" is how every JPEG begins in base 64.
  EXPECT_THAT(same.Source, testing::StartsWith("data:image/jpeg;base64,/9j/"));
}

TEST(ReportChart, DotsStandWhereTheNumbersAre)
{
  const std::string svg =
    SvgOf({ "title", "x", { { "line", { { 0, 0 }, { 5, 1 }, { 10, 2 } } } }, {} });
  const auto dot = [&svg](const std::string& what, const std::string& axis)
  {
    const std::size_t title = svg.find("<title>line " + what);
    const std::size_t circle = svg.rfind("<circle", title);
    return std::stod(Between(svg.substr(circle), " " + axis + "=\"", "\""));
  };
  EXPECT_NEAR(dot("5: 1", "cx"), (dot("0: 0", "cx") + dot("10: 2", "cx")) / 2, 0.11)
    << "a tenth of a pixel is written";
  EXPECT_NEAR(dot("5: 1", "cy"), (dot("0: 0", "cy") + dot("10: 2", "cy")) / 2, 0.11);
  EXPECT_LT(dot("10: 2", "cy"), dot("0: 0", "cy")) << "more is higher";
}

TEST(ReportChart, NothingToDrawIsNoError)
{
  EXPECT_THAT(SvgOf({ "empty", "x", {}, {} }), HasSubstr("</svg>"));
  EXPECT_THAT(SvgOf({ "one", "x", { { "line", { { 0, 5 } } } }, {} }), HasSubstr("<circle"));
  const std::string svg =
    SvgOf({ "gap", "x", { { "line", { { 0, 1 }, { 1, std::nan("") }, { 2, 3 } } } }, {} });
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}
