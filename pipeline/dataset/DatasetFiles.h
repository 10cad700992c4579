// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the data sets: what lies in a folder beside the files that the calibration names.
#ifndef novelview_DatasetFiles_h
#define novelview_DatasetFiles_h

#include "cameras/Photograph.h"

#include <filesystem>
#include <vector>

namespace novelview
{
/**
 * Takes the files that the calibration means for paths that are no files, see FileMeant(); notes how
 * many.
 */
void FindFilesMeant(const std::filesystem::path& folder, std::vector<Photograph>& photographs,
  std::vector<ReadingNote>& notes);

/** Fills in the masks that the calibration does not name; notes what lies there and is not used. */
void FindMasks(const std::filesystem::path& folder, std::vector<Photograph>& photographs,
  std::vector<ReadingNote>& notes);

/** Notes the photographs that lie beside those of the calibration, which has no camera for them. */
void NotePhotographsWithoutCamera(const std::filesystem::path& folder,
  const std::vector<Photograph>& photographs, std::vector<ReadingNote>& notes);
}

#endif
