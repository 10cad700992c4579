// SPDX-License-Identifier: GPL-3.0-or-later
/** Commands that mend a data set, as a shell takes them. */
#ifndef novelview_SuggestedCommand_h
#define novelview_SuggestedCommand_h

#include "dataset/DatasetInput.h"

#include <string>
#include <vector>

namespace novelview
{
/** A command of the program with the options that find the calibration. */
std::string SuggestedCommand(const DatasetInput& input, const std::string& name,
  const std::vector<std::string>& words, const std::string& formatFlag);

/** The command that writes the data set again with these options, beside it. */
std::string ConvertCommand(
  const DatasetInput& input, const std::string& format, const std::vector<std::string>& options);
}

#endif
