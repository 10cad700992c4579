// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/FileCheck.h"

#include "masks/Coverage.h"

#include <algorithm>
#include <string>

namespace novelview
{
void CheckFiles(CheckContext& context)
{
  for (const CheckedPhotograph& photograph : context.Report.Photographs)
  {
    for (const std::string& problem : photograph.Problems)
    {
      context.Add(CheckSeverity::Error, "file", photograph.Name, problem);
    }
    const Coverage& covered = photograph.Covered;
    if (photograph.Mask.Pixels.Values.empty() || !photograph.Problems.empty())
    {
      continue;
    }
    if (covered.Fraction == 0 || covered.Fraction == 1)
    {
      context.Add(CheckSeverity::Error, "empty-mask", photograph.Name,
        covered.Fraction == 0 ? "silhouette is empty" : "silhouette fills the whole frame");
      continue;
    }
    for (const std::string& warning : CheckCoverage(covered, "view"))
    {
      const bool border = warning.find("leaves the frame") != std::string::npos;
      // What the frame cuts in some views the others bound; nothing is wrong.
      context.Add(border ? CheckSeverity::Note : CheckSeverity::Warning,
        border ? "border" : "coverage", photograph.Name,
        warning.substr(std::string("view: ").size()));
    }
  }
  const auto& photographs = context.Report.Photographs;
  if (std::all_of(photographs.begin(), photographs.end(),
        [](const CheckedPhotograph& each) { return each.Covered.TouchesBorder(); }))
  {
    context.Add(CheckSeverity::Warning, "border", "",
      "the frame cuts the object in every view, so the silhouettes may not bound it; --hull-box "
      "does");
  }
  if (context.Report.Photographs.size() < 3)
  {
    context.Add(CheckSeverity::Warning, "views", "",
      std::to_string(context.Report.Photographs.size()) +
        " photographs; a hull needs three at the very least, better twelve");
  }
}
}
