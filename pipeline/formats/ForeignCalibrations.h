// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ForeignCalibrations_h
#define novelview_ForeignCalibrations_h

#include <filesystem>
#include <string>

namespace novelview
{
/** What a folder holds that is a calibration, a photograph or a video of a kind that is not read, and
 * the way out, in one sentence; empty when nothing is known. */
std::string ForeignFilesIn(const std::filesystem::path& folder);

/** The same of a single file. */
std::string ForeignFile(const std::filesystem::path& file);
}

#endif
