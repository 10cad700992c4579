// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Where the energies of preset `paper` have their least, for points whose true position is known.
 *
 *     energy_landscape OUT NAME=DATASET...
 *
 * Every DATASET is a folder of `novelview generate`. Writes OUT/energy.md (also to standard output),
 * OUT/energy.csv (the mean landscapes) and OUT/energy-NAME.png (the same as charts).
 * tests/evaluation/energy.sh generates the objects and runs it.
 */
#include "ArrayNames.h"
#include "base/AtomicFile.h"
#include "base/NumberText.h"
#include "core/Error.h"
#include "drawing/ScoreChart.h"
#include "evaluation/EnergyScene.h"
#include "images/ImageFile.h"

#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace novelview;
using namespace novelview::evaluation;

namespace
{
constexpr int Stride = 5; ///< of the vertices that are no outline points

std::string TableHead()
{
  return "| energy | object | points | least within 1 px | median offset, px | median distance, px "
         "| median valley |\n| --- | --- | --- | --- | --- | --- | --- |\n";
}

std::string RowOf(const std::string& object, const Landscape& landscape)
{
  const LandscapeSummary summary = landscape.Summary();
  return "| " + landscape.Name + " | " + object + " | " + std::to_string(summary.Points) +
    Formatted(" | %.0f %%", 100 * summary.NearShare) + Formatted(" | %.2f", summary.MedianOffset) +
    Formatted(" | %.2f", summary.MedianDistance) + Formatted(" | %.3f |\n", summary.MedianValley);
}

std::string CsvOf(
  const std::string& object, const std::string& points, const std::vector<Landscape>& landscapes)
{
  std::string text;
  for (const Landscape& landscape : landscapes)
  {
    const std::vector<double> mean = landscape.Mean();
    for (int i = 0; i < landscape.Along.Count(); ++i)
    {
      text += object + "," + points + ",\"" + landscape.Name + "\"," +
        Formatted("%.2f", landscape.Along[i]) + "," + Formatted("%.6f", mean[i]) + "\n";
    }
  }
  return text;
}

/** The mean landscapes over the offsets. */
vtkSmartPointer<vtkChartXY> ChartOf(
  const std::vector<Landscape>& landscapes, const std::string& title, ChartStyle style)
{
  const std::vector<Colour> inks{ { 0.80, 0.25, 0.10 }, { 0.10, 0.35, 0.70 }, { 0.95, 0.60, 0.30 },
    { 0.35, 0.65, 0.90 }, { 0.30, 0.55, 0.25 }, { 0.55, 0.45, 0.60 } };
  const Offsets& offsets = landscapes.front().Along;
  const double tickPx = offsets.Range > 10 ? 2 : 1; // so that 0 is among the few that are drawn
  ChartAxis axis{ title };
  for (int i = 0; i * tickPx <= 2 * offsets.Range; ++i)
  {
    axis.Labels.push_back(Formatted("%.0f", i * tickPx - offsets.Range));
  }
  std::vector<ChartLine> lines;
  for (std::size_t line = 0; line < landscapes.size(); ++line)
  {
    lines.push_back({ landscapes[line].Name, inks[line], {} });
    const std::vector<double> mean = landscapes[line].Mean();
    for (int i = 0; i < offsets.Count(); ++i)
    {
      lines.back().Points.push_back({ (offsets[i] + offsets.Range) / tickPx, mean[i] });
    }
  }
  style.ScoreName = "mean energy";
  style.LegendBelow = true;
  return NewLineChart(lines, axis, style);
}

void DrawLandscapes(const std::string& object, const std::vector<Landscape>& outline,
  const std::vector<Landscape>& others, const fs::path& path)
{
  ChartPage page(object + ": energies of preset paper about the true position");
  const int width = ChartPage::Width / 2;
  page.Sheet.AddChart(
    ChartOf(outline, "outline points: novel pixels outwards from the truth", page.Style),
    { 10, 56, width - 20, ChartPage::Height - 66 }, page.Paper);
  page.Sheet.AddChart(
    ChartOf(others, "other points: pixel footprints behind the truth", page.Style),
    { width + 10, 56, width - 20, ChartPage::Height - 66 }, page.Paper);
  WriteArray(path, page.Sheet.Draw(), arrays::Color);
}

int Run(const fs::path& out, const std::vector<std::string>& objects)
{
  std::string outlineRows;
  std::string otherRows;
  std::string csv = "object,points,energy,offset_px,mean\n";
  fs::create_directories(out);
  for (const std::string& object : objects)
  {
    const std::size_t equals = object.find('=');
    if (equals == std::string::npos)
    {
      std::cerr << "energy_landscape: NAME=DATASET expected, found " << object << "\n";
      return 2;
    }
    const std::string name = object.substr(0, equals);
    const EnergyScene scene(object.substr(equals + 1));
    const std::vector<Landscape> outline = OutlineLandscapes(scene);
    const std::vector<Landscape> others = NonOutlineLandscapes(scene, Stride);
    for (const Landscape& landscape : outline)
    {
      outlineRows += RowOf(name, landscape);
    }
    for (const Landscape& landscape : others)
    {
      otherRows += RowOf(name, landscape);
    }
    csv += CsvOf(name, "outline", outline) + CsvOf(name, "non-outline", others);
    DrawLandscapes(name, outline, others, out / ("energy-" + name + ".png"));
  }
  const std::string text = "Outline points, offsets outwards in novel pixels:\n\n" + TableHead() +
    outlineRows + "\nOther points, offsets away from the camera in pixel footprints:\n\n" +
    TableHead() + otherRows;
  std::cout << text;
  WriteTextAtomically(out / "energy.md", text);
  WriteTextAtomically(out / "energy.csv", csv);
  return 0;
}
}

int main(int argc, char** argv)
{
  if (argc < 3)
  {
    std::cerr << "usage: energy_landscape OUT NAME=DATASET...\n";
    return 2;
  }
  try
  {
    return Run(argv[1], { argv + 2, argv + argc });
  }
  catch (const std::exception& error)
  {
    std::cerr << "energy_landscape: " << error.what() << "\n";
    return 1;
  }
}
