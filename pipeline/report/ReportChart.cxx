// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/ReportChart.h"

#include "base/NumberText.h"
#include "report/HtmlText.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
constexpr double ChartWidth = 560;
constexpr double ChartHeight = 300;
constexpr double MarginLeft = 56;
constexpr double MarginRight = 14;
constexpr double MarginTop = 54;
constexpr double MarginBottom = 44;

std::string Px(double value)
{
  return Formatted("%.1f", value);
}

std::string TextTag(
  double x, double y, const char* anchor, const std::string& text, const char* look = "")
{
  return "<text x=\"" + Px(x) + "\" y=\"" + Px(y) + "\" text-anchor=\"" + anchor + "\"" + look +
    ">" + HtmlEscaped(text) + "</text>\n";
}

/** A round distance between the marks of an axis: 1, 2 or 5 times a power of ten. */
double RoundStep(double span, int most)
{
  const double least = span / most;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : { 1.0, 2.0, 5.0 })
  {
    if (factor * power >= least * (1 - 1e-9))
    {
      return factor * power;
    }
  }
  return 10 * power;
}

/** From the data to the picture. */
class ChartFrame
{
public:
  explicit ChartFrame(const ReportChart& chart)
  {
    for (const ReportLine& line : chart.Lines)
    {
      for (const auto& [x, y] : line.Points)
      {
        if (std::isfinite(x) && std::isfinite(y))
        {
          this->Range.extend(Eigen::Vector2d(x, y));
        }
      }
    }
    if (this->Range.isEmpty())
    {
      this->Range.extend(Eigen::Vector2d(0, 0));
    }
    for (int axis = 0; axis < 2; ++axis)
    {
      if (this->Range.sizes()[axis] <= 0)
      {
        const double around = this->Range.min()[axis];
        const double half = std::max(std::abs(around) / 2, 0.5);
        this->Range.min()[axis] = around - half;
        this->Range.max()[axis] = around + half;
      }
    }
    this->YStep = RoundStep(this->Range.sizes().y(), 6);
    this->Range.min().y() = std::floor(this->Range.min().y() / this->YStep) * this->YStep;
    this->Range.max().y() = std::ceil(this->Range.max().y() / this->YStep) * this->YStep;
    this->XStep = std::max(1.0, RoundStep(this->Range.sizes().x(), 10));
  }

  double X(double x) const
  {
    return MarginLeft +
      (x - this->Range.min().x()) / this->Range.sizes().x() *
      (ChartWidth - MarginLeft - MarginRight);
  }
  double Y(double y) const
  {
    return ChartHeight - MarginBottom -
      (y - this->Range.min().y()) / this->Range.sizes().y() *
      (ChartHeight - MarginTop - MarginBottom);
  }

  std::string Axes(const ReportChart& chart) const
  {
    std::string svg;
    for (int i = 0;
         this->Range.min().y() + i * this->YStep <= this->Range.max().y() + this->YStep / 2; ++i)
    {
      const double y = this->Range.min().y() + i * this->YStep;
      svg += "<line class=\"grid\" x1=\"" + Px(MarginLeft) + "\" x2=\"" +
        Px(ChartWidth - MarginRight) + "\" y1=\"" + Px(this->Y(y)) + "\" y2=\"" + Px(this->Y(y)) +
        "\"/>\n";
      // A step's own rounding would show at zero.
      svg += TextTag(MarginLeft - 8, this->Y(y) + 4, "end",
        Formatted("%.4g", std::abs(y) < this->YStep / 2 ? 0 : y));
    }
    for (double x = std::ceil(this->Range.min().x() / this->XStep) * this->XStep;
         x <= this->Range.max().x() + this->XStep * 1e-9; x += this->XStep)
    {
      const auto at = static_cast<std::size_t>(std::max(x, 0.0));
      const std::string label = chart.XLabels.empty()
        ? Formatted("%.4g", x)
        : (at < chart.XLabels.size() ? chart.XLabels[at] : "");
      svg += TextTag(this->X(x), ChartHeight - MarginBottom + 18, "middle", label);
    }
    return svg +
      TextTag((ChartWidth + MarginLeft - MarginRight) / 2, ChartHeight - 8, "middle", chart.XTitle);
  }

private:
  Eigen::AlignedBox2d Range;
  double XStep = 1;
  double YStep = 1;
};

std::string LineTags(const ReportLine& line, const ChartFrame& frame, int number)
{
  std::string path;
  std::string dots;
  for (const auto& [x, y] : line.Points)
  {
    if (!std::isfinite(x) || !std::isfinite(y))
    {
      continue;
    }
    path += (path.empty() ? "M" : "L") + Px(frame.X(x)) + " " + Px(frame.Y(y));
    // The tooltip of a point.
    dots += "<circle r=\"3.5\" cx=\"" + Px(frame.X(x)) + "\" cy=\"" + Px(frame.Y(y)) +
      "\"><title>" + HtmlEscaped(line.Name) + " " + Formatted("%.6g", x) + ": " +
      Formatted("%.6g", y) + "</title></circle>";
  }
  return "<g class=\"line" + std::to_string(number % 5) + "\"><path d=\"" + path + "\"/>" + dots +
    "</g>\n";
}
}

std::string SvgOf(const ReportChart& chart)
{
  const ChartFrame frame(chart);
  std::string svg = "<svg viewBox=\"0 0 " + Formatted("%.0f", ChartWidth) + " " +
    Formatted("%.0f", ChartHeight) + "\" role=\"img\">\n<title>" + HtmlEscaped(chart.Title) +
    "</title>\n";
  svg += TextTag(MarginLeft, 18, "start", chart.Title, " class=\"heading\"");
  svg += frame.Axes(chart);
  double x = MarginLeft;
  for (std::size_t i = 0; i < chart.Lines.size(); ++i)
  {
    const ReportLine& line = chart.Lines[i];
    const std::string number = std::to_string(i % 5);
    svg += LineTags(line, frame, static_cast<int>(i));
    svg += "<rect class=\"key" + number + "\" x=\"" + Px(x) + "\" y=\"30\" width=\"12\" " +
      "height=\"4\"/>\n" + TextTag(x + 17, 37, "start", line.Name);
    x += 17 + 7.2 * static_cast<double>(line.Name.size()) + 16;
  }
  return svg + "</svg>";
}
}
