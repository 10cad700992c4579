// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MaskCommand_h
#define novelview_MaskCommand_h

#include "base/Console.h"
#include "commands/MaskOptions.h"
#include "images/ImageFile.h"

#include <cstdint>
#include <filesystem>

namespace novelview
{
/**
 * Writes a mask for every photograph of a data set: mask/NAME for a PNG file NAME, mask/NAME.png for
 * others, in the out folder or (InPlace) in the data set itself, and contact-sheet.png in the out
 * folder or in mask/. A folder without a calibration is one of photographs. Masks are those of the
 * photographs as they are, not undistorted.
 *
 * Nothing is written when one of the silhouettes cannot be found, or when there are masks already and
 * Overwrite is not set. Throws UsageError for the latter and Error, naming the photograph.
 */
void WriteMasks(const MaskOptions& options, Console& console);

/** The mask of one photograph, by the method that the options name. Throws Error. */
Image<std::uint8_t> MaskOf(const std::filesystem::path& photograph, const MaskOptions& options,
  const ColorReading& reading = {});
}

#endif
