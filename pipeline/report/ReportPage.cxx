// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/ReportPage.h"

#include "base/JsonFile.h"
#include "base/NumberText.h"
#include "core/Error.h"
#include "images/ImageFile.h"
#include "images/OpenCvPixels.h"
#include "report/HtmlText.h"
#include "report/ReportTemplate.h"

#include <vtkBase64Utilities.h>

#include <algorithm>

namespace novelview
{
using Json = nlohmann::ordered_json;

namespace
{
std::string Attribute(const std::string& name, const std::string& value)
{
  return " " + name + "=\"" + HtmlEscaped(value) + "\"";
}

std::string ImageTag(const ReportPicture& picture, const std::string& more = "")
{
  return "<img" + Attribute("alt", picture.Caption.empty() ? picture.Name : picture.Caption) +
    Attribute("width", std::to_string(picture.Width)) +
    Attribute("height", std::to_string(picture.Height)) + more + " src=\"" + picture.Source + "\">";
}

std::string FigureTag(const ReportPicture& picture)
{
  return "<figure" + Attribute("data-name", picture.Name) + ">" + ImageTag(picture) +
    "<figcaption>" + HtmlEscaped(picture.Caption) + "</figcaption></figure>\n";
}

/** A cell of a table; `part` of it is filled by a bar, none when negative. */
std::string CellTag(const ReportCell& cell, bool first, double part)
{
  std::string tag = first ? "<th scope=\"row\"" : "<td";
  if (cell.Value)
  {
    const std::string value = NumberText(*cell.Value);
    tag += Attribute("data-value", value) + Attribute("title", value);
  }
  if (part >= 0)
  {
    tag += " class=\"part\"" + Attribute("style", Formatted("--part: %.1f%%", 100 * part));
  }
  return tag + ">" + HtmlEscaped(cell.Text) + (first ? "</th>" : "</td>");
}

/** Replaces each {{NAME}} of the template once, so that inserted text is not expanded again. */
std::string Filled(const std::string& text, const std::vector<std::array<std::string, 2>>& values)
{
  std::string filled;
  std::size_t from = 0;
  for (std::size_t at = text.find("{{"); at != std::string::npos; at = text.find("{{", from))
  {
    const std::size_t end = text.find("}}", at);
    const std::string name = text.substr(at + 2, end - at - 2);
    const auto value = std::find_if(
      values.begin(), values.end(), [&name](const auto& each) { return each[0] == name; });
    if (value == values.end())
    {
      throw Error("report template", "has an unknown place", name, "one of those that are filled");
    }
    filled += text.substr(from, at - from) + (*value)[1];
    from = end + 2;
  }
  return filled + text.substr(from);
}
}

//------------------------------------------------------------------------------
ReportPicture EmbedPicture(const std::string& name, const std::string& caption,
  const ImageRef<const std::uint8_t>& pixels, int longestSidePx, int quality)
{
  const auto small = FromMat<std::uint8_t>(Shrunk(ToMat(pixels), { longestSidePx, longestSidePx }));
  const std::vector<std::uint8_t> jpeg =
    EncodeJpeg(small.Ref(), quality, "report: picture " + name);
  std::string text((jpeg.size() + 2) / 3 * 4 + 4, '\0');
  text.resize(vtkBase64Utilities::Encode(
    jpeg.data(), jpeg.size(), reinterpret_cast<unsigned char*>(text.data())));
  return { name, caption, "data:image/jpeg;base64," + text, small.Width, small.Height };
}

ReportCell::ReportCell(double value, const char* format)
  : Text(Formatted(format, value))
  , Value(value)
{
}

//------------------------------------------------------------------------------
ReportPage::ReportPage(std::string title, std::string subtitle)
  : Title(std::move(title))
  , Subtitle(std::move(subtitle))
{
}

void ReportPage::BeginSection(const std::string& id, const std::string& heading)
{
  this->Body += this->InSection ? "</section>\n" : "";
  this->InSection = true;
  this->Body += "<section" + Attribute("id", id) + ">\n<h2>" + HtmlEscaped(heading) + "</h2>\n";
  this->Links += "<a" + Attribute("href", "#" + id) + ">" + HtmlEscaped(heading) + "</a>\n";
}

void ReportPage::AddText(const std::string& text)
{
  this->Body += "<p>" + HtmlEscaped(text) + "</p>\n";
}

void ReportPage::AddTiles(const std::vector<std::pair<std::string, std::string>>& tiles)
{
  this->Body += "<dl class=\"tiles\">\n";
  for (const auto& [name, value] : tiles)
  {
    this->Body +=
      "<div><dt>" + HtmlEscaped(name) + "</dt><dd>" + HtmlEscaped(value) + "</dd></div>\n";
  }
  this->Body += "</dl>\n";
}

void ReportPage::AddGallery(const std::vector<ReportPicture>& pictures)
{
  this->Body += "<div class=\"gallery\">\n";
  for (const ReportPicture& picture : pictures)
  {
    this->Body += FigureTag(picture);
  }
  this->Body += "</div>\n";
}

void ReportPage::AddPicture(const ReportPicture& picture)
{
  this->Body += "<div class=\"wide\">" + FigureTag(picture) + "</div>\n";
}

void ReportPage::AddComparison(const std::string& id, const std::vector<ReportPicture>& pictures,
  const std::string& left, const std::string& right)
{
  this->Body += "<div class=\"compare\"" + Attribute("id", id) + Attribute("data-left", left) +
    Attribute("data-right", right) + ">\n<div class=\"shots\">\n";
  for (const ReportPicture& picture : pictures)
  {
    this->Body += FigureTag(picture);
  }
  this->Body += "</div>\n</div>\n";
}

void ReportPage::AddPlayer(const std::string& id, const std::vector<ReportFrame>& frames)
{
  this->Body += "<div class=\"player\"" + Attribute("id", id) + ">\n<ol class=\"strip\">\n";
  for (const ReportFrame& frame : frames)
  {
    this->Body += "<li><figure>";
    for (const ReportPicture& picture : frame.Pictures)
    {
      this->Body += ImageTag(picture, Attribute("data-track", picture.Name));
    }
    this->Body += "<figcaption>" + HtmlEscaped(frame.Caption) + "</figcaption></figure></li>\n";
  }
  this->Body += "</ol>\n</div>\n";
}

void ReportPage::AddTable(const ReportTable& table)
{
  double most = 0;
  for (const std::vector<ReportCell>& row : table.Rows)
  {
    most = std::max(most, table.BarColumn < 0 ? 0 : row[table.BarColumn].Value.value_or(0));
  }
  this->Body += "<div class=\"scroll\"><table" + Attribute("id", table.Id) + ">\n<caption>" +
    HtmlEscaped(table.Caption) + "</caption>\n<thead><tr>";
  for (const std::string& column : table.Columns)
  {
    this->Body += "<th scope=\"col\">" + HtmlEscaped(column) + "</th>";
  }
  this->Body += "</tr></thead>\n<tbody>\n";
  for (const std::vector<ReportCell>& row : table.Rows)
  {
    this->Body += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      const bool bar = static_cast<int>(i) == table.BarColumn && most > 0;
      this->Body += CellTag(row[i], i == 0, bar ? row[i].Value.value_or(0) / most : -1);
    }
    this->Body += "</tr>\n";
  }
  this->Body += "</tbody>\n</table></div>\n";
}

void ReportPage::AddCharts(const std::vector<ReportChart>& charts)
{
  this->Body += "<div class=\"charts\">\n";
  for (const ReportChart& chart : charts)
  {
    this->Body += "<figure class=\"chart\">" + SvgOf(chart) + "</figure>\n";
  }
  this->Body += "</div>\n";
}

void ReportPage::AddJson(const std::string& id, const std::string& heading, const Json& value)
{
  this->Body += "<details" + Attribute("id", id) + "><summary>" + HtmlEscaped(heading) +
    "</summary>\n<pre tabindex=\"0\">" + HtmlEscaped(DumpJson(value)) + "</pre></details>\n";
}

std::string ReportPage::Html(const Json& data) const
{
  // Inside a script element only "<" can end it or begin a comment.
  std::string block = DumpJson(data, 1);
  for (std::size_t at = block.find('<'); at != std::string::npos; at = block.find('<', at))
  {
    block.replace(at, 1, "\\u003c");
  }
  return Filled(reporttemplate::Page,
    { { { "title", HtmlEscaped(this->Title) } }, { { "subtitle", HtmlEscaped(this->Subtitle) } },
      { { "links", this->Links } }, { { "style", reporttemplate::Style } },
      { { "script", reporttemplate::Script } },
      { { "body", this->Body + (this->InSection ? "</section>\n" : "") } },
      { { "data", block } } });
}
}
