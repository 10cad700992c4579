// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * A report as one HTML file that needs nothing else: images, styles and script are inside, nothing
 * is fetched. Everything can be read without the script, which adds sliders and a player.
 *
 * All texts are plain: they are escaped here, and bytes that are no UTF-8 are replaced.
 */
#ifndef novelview_ReportPage_h
#define novelview_ReportPage_h

#include "core/ImageRef.h"
#include "report/ReportChart.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace novelview
{
/** An image inside a page. */
struct ReportPicture
{
  std::string Name;    ///< short, e.g. for a choice: "full"
  std::string Caption; ///< a line below it
  std::string Source;  ///< "data:image/jpeg;base64,..."
  int Width = 0;       ///< as embedded, px
  int Height = 0;
};

/**
 * The pixels (RGB or grey) as a JPEG of at most this many pixels on the longer side; smaller ones
 * are not enlarged. Throws Error when they cannot be encoded.
 */
ReportPicture EmbedPicture(const std::string& name, const std::string& caption,
  const ImageRef<const std::uint8_t>& pixels, int longestSidePx, int quality = 90);

/** A cell of a table: a text, or a number, of which the page keeps every digit. */
struct ReportCell
{
  ReportCell(std::string text)
    : Text(std::move(text))
  {
  }
  ReportCell(double value, const char* format);

  std::string Text;
  std::optional<double> Value;
};

struct ReportTable
{
  std::string Id; ///< of the element
  std::string Caption;
  std::vector<std::string> Columns;
  std::vector<std::vector<ReportCell>> Rows;
  int BarColumn = -1; ///< its numbers are also drawn as bars; -1 = none
};

/** One step of a player: its line of text and an image for each of the player's tracks. */
struct ReportFrame
{
  std::string Caption;
  std::vector<ReportPicture> Pictures; ///< as many as there are tracks, Name = the track's
};

class ReportPage
{
public:
  ReportPage(std::string title, std::string subtitle);

  /** Everything added from here on stands under this heading; `id` is a word of letters. */
  void BeginSection(const std::string& id, const std::string& heading);

  void AddText(const std::string& text);
  /** Numbers to see first: what it is, and its value. */
  void AddTiles(const std::vector<std::pair<std::string, std::string>>& tiles);
  void AddGallery(const std::vector<ReportPicture>& pictures);
  void AddPicture(const ReportPicture& picture);
  /** Images of one size, of which any two can be laid over each other with a slider. */
  void AddComparison(const std::string& id, const std::vector<ReportPicture>& pictures,
    const std::string& left, const std::string& right);
  /** Images one after the other. */
  void AddPlayer(const std::string& id, const std::vector<ReportFrame>& frames);
  void AddTable(const ReportTable& table);
  void AddCharts(const std::vector<ReportChart>& charts);
  /** JSON to read, below a line that opens it. */
  void AddJson(
    const std::string& id, const std::string& heading, const nlohmann::ordered_json& value);

  /** The whole file; `data` goes into it as one block of JSON, the element "report-data". */
  std::string Html(const nlohmann::ordered_json& data) const;

private:
  std::string Title;
  std::string Subtitle;
  std::string Links;
  std::string Body;
  bool InSection = false;
};
}

#endif
