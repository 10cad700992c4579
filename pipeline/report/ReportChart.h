// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ReportChart_h
#define novelview_ReportChart_h

#include <array>
#include <string>
#include <vector>

namespace novelview
{
/** A line of a chart; points that are not finite are left out. */
struct ReportLine
{
  std::string Name;
  std::vector<std::array<double, 2>> Points; ///< x, y
};

struct ReportChart
{
  std::string Title;
  std::string XTitle;
  std::vector<ReportLine> Lines;
  std::vector<std::string> XLabels = {}; ///< what stands at 0, 1, 2 ..; numbers when empty
};

/** The chart as an SVG element, coloured by the page's styles. */
std::string SvgOf(const ReportChart& chart);
}

#endif
