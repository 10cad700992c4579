// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/ExposureCheck.h"

#include "base/NumberText.h"
#include "core/Quantile.h"

#include <cstddef>
#include <vector>

namespace novelview
{
namespace
{
std::vector<double> Values(const CheckContext& context, double CheckedPhotograph::*member)
{
  std::vector<double> values;
  for (const CheckedPhotograph& photograph : context.Report.Photographs)
  {
    values.push_back(photograph.*member);
  }
  return values;
}
}

void CheckExposure(CheckContext& context)
{
  const std::vector<double> sharpness = Values(context, &CheckedPhotograph::Sharpness);
  for (const std::size_t i : FindOutliers(sharpness, 1.4, { true, false }))
  {
    context.Add(CheckSeverity::Warning, "blurred", context.Report.Photographs[i].Name,
      Formatted("sharpness %.2f", sharpness[i]) +
        Formatted(", the others' median is %.2f: out of focus or moved", Quantile(sharpness, 0.5)));
  }
  const std::vector<double> brightness = Values(context, &CheckedPhotograph::Brightness);
  const double clipped = Quantile(Values(context, &CheckedPhotograph::Clipped), 0.5);
  for (const std::size_t i : FindOutliers(brightness, 1.6, {}))
  {
    const CheckedPhotograph& photograph = context.Report.Photographs[i];
    const bool over = brightness[i] > Quantile(brightness, 0.5);
    context.Add(CheckSeverity::Warning, over ? "overexposed" : "underexposed", photograph.Name,
      Formatted("the object's median is %.0f", brightness[i]) +
        Formatted(" levels, in the others %.0f", Quantile(brightness, 0.5)) +
        Formatted("; %.0f %% of it are clipped", 100 * photograph.Clipped));
  }
  for (const CheckedPhotograph& photograph : context.Report.Photographs)
  {
    for (const std::string& warning : photograph.Warnings)
    {
      context.Add(CheckSeverity::Warning, "tones", photograph.Name, warning);
    }
    if (photograph.Clipped > clipped + 0.1)
    {
      context.Add(CheckSeverity::Warning, "clipped", photograph.Name,
        Formatted("%.0f %% of the object are clipped in some channel", 100 * photograph.Clipped) +
          Formatted(", in the others %.0f %%", 100 * clipped));
    }
  }
}
}
