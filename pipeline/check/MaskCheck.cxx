// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/MaskCheck.h"

#include "base/NumberText.h"
#include "cameras/PhotographFiles.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
/** Images in the folders of masks that belong to no photograph. */
std::vector<std::string> StrayMasks(const CheckContext& context)
{
  std::vector<std::string> stray;
  for (const char* folder : { "mask", "masks", "silhouettes" })
  {
    for (const std::string& name : PhotographsIn(context.Index.Folder / folder))
    {
      const fs::path file = context.Index.Folder / folder / name;
      const bool used = std::any_of(context.Index.Cameras.begin(), context.Index.Cameras.end(),
        [&](const Photograph& each) { return each.Mask == file; });
      if (!used)
      {
        stray.push_back((fs::path(folder) / name).string());
      }
    }
  }
  return stray;
}
}

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
  std::vector<std::string> stray = StrayMasks(context);
  const bool more = stray.size() > 3;
  stray.resize(std::min<std::size_t>(stray.size(), 3));
  const std::string unmatched = stray.empty()
    ? ""
    : "; masks that belong to no photograph: " + Joined(stray) + (more ? " .." : "");
  if (given == 0)
  {
    context.Add(stray.empty() ? CheckSeverity::Note : CheckSeverity::Warning, "mask-missing", "",
      "no masks: silhouettes are extracted from the photographs" + unmatched);
    return;
  }
  for (const std::string& name : without)
  {
    context.Add(CheckSeverity::Warning, "mask-missing", name,
      "has no mask, others have; its silhouette is extracted from the photograph" + unmatched);
  }
}
}
