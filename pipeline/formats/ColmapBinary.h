// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ColmapBinary_h
#define novelview_ColmapBinary_h

#include "formats/ColmapModel.h"
#include "formats/DatasetFormats.h"

#include <filesystem>
#include <vector>

namespace novelview
{
/** cameras.bin and images.bin of a folder. Throws Error, naming file and byte. */
ColmapModel ReadColmapBinary(const std::filesystem::path& folder);
/** The same, and an empty points3D.bin. */
std::vector<FileContent> ComposeColmapBinary(const ColmapModel& model);
}

#endif
