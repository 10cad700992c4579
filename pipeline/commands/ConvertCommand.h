// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ConvertCommand_h
#define novelview_ConvertCommand_h

#include "base/Console.h"
#include "commands/ConvertOptions.h"

namespace novelview
{
/**
 * Writes a data set in another format, with its photographs and those of its masks that are given
 * (silhouettes are not extracted). Files that need not change are copied byte for byte; photographs
 * whose distortion the format cannot represent are undistorted, and then are PNG files. The
 * calibration is written last. Throws UsageError when the folder to write is the one to read or
 * already contains another data set, and Error when the format cannot represent a camera, before
 * anything is written.
 */
void ConvertDataset(const ConvertOptions& options, Console& console);
}

#endif
