// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/CheckReport.h"

#include <algorithm>

namespace novelview
{
bool CheckReport::HasProblems() const
{
  return std::any_of(this->Findings.begin(), this->Findings.end(),
    [](const CheckFinding& finding) { return finding.Severity != CheckSeverity::Note; });
}

const char* SeverityName(CheckSeverity severity)
{
  return severity == CheckSeverity::Error
    ? "error"
    : (severity == CheckSeverity::Warning ? "warning" : "note");
}
}
