// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ColmapText_h
#define novelview_ColmapText_h

#include "formats/ColmapModel.h"
#include "formats/DatasetFormats.h"

#include <filesystem>
#include <vector>

namespace novelview
{
/** cameras.txt and images.txt of a folder. Throws Error, naming file and line. */
ColmapModel ReadColmapText(const std::filesystem::path& folder);
/** The same, and an empty points3D.txt. Throws Error when a name has blanks. */
std::vector<FileContent> ComposeColmapText(const ColmapModel& model);
}

#endif
