// SPDX-License-Identifier: GPL-3.0-or-later
#include "masks/Coverage.h"

#include "base/NumberText.h"
#include "core/Error.h"

#include <utility>

namespace novelview
{
Coverage MeasureCoverage(const ImageRef<const std::uint8_t>& mask)
{
  Coverage coverage;
  std::int64_t count = 0;
  for (int y = 0; y < mask.Height; ++y)
  {
    for (int x = 0; x < mask.Width; ++x)
    {
      if (mask(x, y) > 127)
      {
        ++count;
        coverage.Left |= x == 0;
        coverage.Right |= x == mask.Width - 1;
        coverage.Top |= y == 0;
        coverage.Bottom |= y == mask.Height - 1;
      }
    }
  }
  coverage.Fraction = double(count) / (double(mask.Width) * mask.Height);
  return coverage;
}

std::vector<std::string> CheckCoverage(const Coverage& coverage, const std::string& where)
{
  if (coverage.Fraction == 0)
  {
    throw Error(where, "silhouette is empty");
  }
  if (coverage.Fraction == 1)
  {
    throw Error(where, "silhouette fills the whole frame");
  }
  std::vector<std::string> words;
  if (coverage.TouchesBorder())
  {
    std::string sides;
    const std::pair<bool, const char*> each[] = { { coverage.Left, "left" },
      { coverage.Right, "right" }, { coverage.Top, "top" }, { coverage.Bottom, "bottom" } };
    for (const auto& [touches, name] : each)
    {
      sides += touches ? (sides.empty() ? "" : ", ") + std::string(name) : "";
    }
    words.push_back(where + ": the object leaves the frame (" + sides +
      "); what lies outside it is treated as unknown");
  }
  // Objects that fill less than a two-hundredth of the frame, or all but a tenth of it, are more
  // often a silhouette gone wrong than an object.
  if (coverage.Fraction < 0.005 || coverage.Fraction > 0.9)
  {
    words.push_back(where + ": the silhouette covers " +
      Formatted("%.2f %%", 100 * coverage.Fraction) + " of the frame; is that the object?");
  }
  return words;
}
}
