// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/CheckCommand.h"

#include "Threads.h"
#include "base/AtomicFile.h"
#include "base/JsonFile.h"
#include "base/NumberText.h"
#include "check/CheckPicture.h"
#include "commands/CommandSupport.h"
#include "core/Quantile.h"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace novelview
{
namespace
{
using Json = nlohmann::ordered_json;

const char* MaskText(MaskSource source)
{
  return source == MaskSource::File ? "file"
                                    : (source == MaskSource::Alpha ? "alpha" : "extracted");
}

std::string SidesText(const Coverage& covered)
{
  return std::string(covered.Left ? "L" : "") + (covered.Right ? "R" : "") +
    (covered.Top ? "T" : "") + (covered.Bottom ? "B" : "");
}

/** "12 of 640x480", with every size that there is. */
std::string SizesText(const CheckReport& report)
{
  std::vector<std::pair<std::string, int>> sizes;
  for (const CheckedPhotograph& photograph : report.Photographs)
  {
    const std::string size =
      photograph.Width > 0 ? SizeText(photograph.Width, photograph.Height) : "unreadable";
    const auto known = std::find_if(
      sizes.begin(), sizes.end(), [&](const auto& each) { return each.first == size; });
    if (known == sizes.end())
    {
      sizes.emplace_back(size, 1);
    }
    else
    {
      ++known->second;
    }
  }
  std::vector<std::string> words;
  for (const auto& [size, count] : sizes)
  {
    words.push_back(std::to_string(count) + " of " + size);
  }
  return Joined(words);
}

/** "12 files, 1 extracted" */
std::string MasksText(const CheckReport& report)
{
  std::vector<std::string> words;
  for (const auto& [source, name] :
    { std::pair(MaskSource::File, " files"), std::pair(MaskSource::Alpha, " alpha channels"),
      std::pair(MaskSource::Extracted, " extracted from the photographs") })
  {
    const auto count = std::count_if(report.Photographs.begin(), report.Photographs.end(),
      [&, wanted = source](const CheckedPhotograph& photograph)
      { return photograph.Mask.Source == wanted && photograph.Width > 0; });
    if (count > 0)
    {
      words.push_back(std::to_string(count) + name);
    }
  }
  return words.empty() ? "none" : Joined(words);
}

std::string ViewRow(const CheckReport& report, std::size_t i, std::size_t nameWidth)
{
  const CheckedPhotograph& photograph = report.Photographs[i];
  const CheckedCamera& camera = report.Agreement[i];
  const std::string size =
    photograph.Width > 0 ? SizeText(photograph.Width, photograph.Height) : "unreadable";
  std::string row = fmt::format(
    "  {:>3}  {:<{}}  {:<10} {:<9} {:>6.1f} % {:<4}  {:>5.2f}  {:>6.0f}", i, photograph.Name,
    nameWidth, size, MaskText(photograph.Mask.Source), 100 * photograph.Covered.Fraction,
    SidesText(photograph.Covered), photograph.Sharpness, photograph.Brightness);
  row += camera.TakesPart
    ? fmt::format("  {:>6.3f}  {:>5.1f} %", camera.Iou, 100 * camera.ExclusivelyCarved)
    : "       -        -";
  if (report.MeanIouAfter)
  {
    row += camera.IouAfter ? fmt::format("  {:>6.3f}", *camera.IouAfter) : "       -";
  }
  return row;
}

std::string FindingText(const CheckFinding& finding)
{
  const std::string text = (finding.View.empty() ? "" : finding.View + ": ") + finding.Text;
  return finding.Command.empty() ? text : text + " -> " + finding.Command;
}

std::string FindingLine(const CheckFinding& finding)
{
  return fmt::format(
    "{:<8} {:<15} {}", SeverityName(finding.Severity), finding.Kind, FindingText(finding));
}

/** Prints the problems where the table is not visible. */
void ReportProblems(const CheckReport& report, Console& console)
{
  for (const CheckFinding& finding : report.Findings)
  {
    const std::string text = finding.Kind + ": " + FindingText(finding);
    if (finding.Severity == CheckSeverity::Error)
    {
      console.Error(text);
    }
    else if (finding.Severity == CheckSeverity::Warning)
    {
      console.Warn(text);
    }
  }
}

Json ViewJson(const CheckReport& report, std::size_t i)
{
  const CheckedPhotograph& photograph = report.Photographs[i];
  const CheckedCamera& camera = report.Agreement[i];
  const Coverage& covered = photograph.Covered;
  Json border = Json::array();
  for (const auto& [touches, side] :
    { std::pair(covered.Left, "left"), std::pair(covered.Right, "right"),
      std::pair(covered.Top, "top"), std::pair(covered.Bottom, "bottom") })
  {
    if (touches)
    {
      border.push_back(side);
    }
  }
  Json view = { { "name", photograph.Name }, { "file", report.Cameras[i].File.string() },
    { "mask", MaskText(photograph.Mask.Source) }, { "maskFile", report.Cameras[i].Mask.string() },
    { "width", photograph.Width }, { "height", photograph.Height },
    { "coverage", covered.Fraction }, { "border", border }, { "sharpness", photograph.Sharpness },
    { "brightness", photograph.Brightness }, { "clipped", photograph.Clipped } };
  view["hullIou"] = camera.TakesPart ? Json(camera.Iou) : Json();
  view["hullIouWithoutBlamed"] = camera.IouAfter ? Json(*camera.IouAfter) : Json();
  view["against"] = camera.TakesPart ? Json(camera.ExclusivelyCarved) : Json();
  view["blamed"] = camera.Outlier;
  return view;
}

Json FindingJson(const CheckFinding& finding)
{
  return { { "severity", SeverityName(finding.Severity) }, { "kind", finding.Kind },
    { "view", finding.View.empty() ? Json() : Json(finding.View) }, { "text", finding.Text },
    { "options", finding.Options },
    { "command", finding.Command.empty() ? Json() : Json(finding.Command) } };
}

Json TrialJson(const ConventionTrial& trial)
{
  return { { "changes", trial.Changes }, { "options", trial.Options },
    { "readable", trial.Readable }, { "hullIou", trial.Iou } };
}
}

std::vector<std::string> CheckTable(const CheckReport& report)
{
  std::vector<std::string> lines;
  lines.push_back("calibration  " + report.Calibration.string() + " (" + report.Format + "), " +
    std::to_string(report.Cameras.size()) + " cameras");
  lines.push_back("photographs  " + SizesText(report));
  lines.push_back("masks        " + MasksText(report));
  std::size_t nameWidth = 4;
  for (const CheckedPhotograph& photograph : report.Photographs)
  {
    nameWidth = std::max(nameWidth, photograph.Name.size());
  }
  lines.push_back(
    fmt::format("  {:>3}  {:<{}}  {:<10} {:<9} {:>8} {:<4}  {:>5}  {:>6}  {:>6}  {:>7}{}", "no",
      "view", nameWidth, "size", "mask", "object", "cut", "sharp", "bright", "hull", "against",
      report.MeanIouAfter ? "   after" : ""));
  for (std::size_t i = 0; i < report.Photographs.size(); ++i)
  {
    lines.push_back(ViewRow(report, i, nameWidth));
  }
  lines.push_back(fmt::format("hull IoU     {:.3f} in the mean", report.MeanIou) +
    (report.MeanIouAfter ? fmt::format(", {:.3f} without the outlier views", *report.MeanIouAfter)
                         : ""));
  for (const CheckFinding& finding : report.Findings)
  {
    lines.push_back(FindingLine(finding));
  }
  if (!report.HasProblems())
  {
    lines.push_back("ok       no problems found");
  }
  return lines;
}

std::string CheckJson(const CheckReport& report)
{
  Json json = { { "dataset", report.Folder.string() },
    { "calibration", report.Calibration.string() }, { "format", report.Format },
    { "problems", report.HasProblems() } };
  json["findings"] = Json::array();
  for (const CheckFinding& finding : report.Findings)
  {
    json["findings"].push_back(FindingJson(finding));
  }
  json["hullIou"] = report.MeanIou;
  json["hullIouWithoutBlamed"] = report.MeanIouAfter ? Json(*report.MeanIouAfter) : Json();
  json["views"] = Json::array();
  for (std::size_t i = 0; i < report.Photographs.size(); ++i)
  {
    json["views"].push_back(ViewJson(report, i));
  }
  json["conventions"] = Json::array();
  for (const ConventionTrial& trial : report.Trials)
  {
    json["conventions"].push_back(TrialJson(trial));
  }
  json["chosenConvention"] = report.ChosenTrial;
  json["masksInverted"] = report.MasksInverted;
  json["pixelCentre"] = Json();
  if (report.PixelCentre)
  {
    const std::vector<double>& loss = report.PixelCentre->LossPx;
    json["pixelCentre"] = { { "lossPx", loss[0] }, { "lossOtherPx", loss[1] },
      { "lossBeyondPx", loss[2] }, { "lossOppositePx", loss[3] },
      { "sigmas", report.PixelCentre->Sigmas } };
  }
  return DumpJson(json) + "\n";
}

bool RunCheck(const CheckOptions& options, Console& console)
{
  if (!options.Out.empty())
  {
    PrepareFolder(options.Out, { "cameras.png", "check.json" });
  }
  Execution execution;
  execution.ParallelFor = ParallelFor;
  execution.Progress = [&console](double fraction) { return console.Progress("check", fraction); };
  CheckReport report;
  console.RunTimed("check", [&] { report = CheckDataset(options.Input, execution); });
  for (const std::string& line : CheckTable(report))
  {
    console.Info(line);
  }
  if (console.IsQuiet())
  {
    ReportProblems(report, console);
  }
  if (!options.Out.empty())
  {
    DrawCheckedCameras(report, options.Out / "cameras.png");
    WriteTextAtomically(options.Out / "check.json", CheckJson(report));
    console.Info("written to " + options.Out.string());
  }
  return !report.HasProblems();
}
}
