// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CheckCommand_h
#define novelview_CheckCommand_h

#include "base/Console.h"
#include "check/DatasetCheck.h"
#include "commands/CheckOptions.h"

#include <string>
#include <vector>

namespace novelview
{
/**
 * Examines a data set and reports the findings: a table on the console and, with an output folder,
 * `check.json` (everything that was measured) and `cameras.png` (see DrawCheckedCameras()). Returns
 * whether there are no problems. Throws as CheckDataset().
 */
bool RunCheck(const CheckOptions& options, Console& console);

/** The table, line by line. */
std::vector<std::string> CheckTable(const CheckReport& report);

/** Everything as JSON. */
std::string CheckJson(const CheckReport& report);
}

#endif
