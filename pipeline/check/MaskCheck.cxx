// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/MaskCheck.h"

#include <cstddef>
#include <string>
#include <vector>

namespace novelview
{
void CheckMasks(CheckContext& context)
{
  std::vector<std::string> without;
  std::size_t given = 0;
  for (const CheckedPhotograph& photograph : context.Report.Photographs)
  {
    const bool extracted = photograph.Mask.Source == MaskSource::Extracted;
    given += !extracted;
    if (extracted && photograph.Problems.empty())
    {
      without.push_back(photograph.Name);
    }
  }
  if (without.empty() || context.Input.ForceSilhouettes)
  {
    return;
  }
  if (given == 0)
  {
    context.Add(CheckSeverity::Note, "mask-missing", "",
      "no masks: silhouettes are extracted from the photographs");
    return;
  }
  for (const std::string& name : without)
  {
    context.Add(CheckSeverity::Warning, "mask-missing", name,
      "has no mask, others have; its silhouette is extracted from the photograph");
  }
}
}
