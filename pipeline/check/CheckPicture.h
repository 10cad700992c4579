// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CheckPicture_h
#define novelview_CheckPicture_h

#include "check/CheckReport.h"

#include <filesystem>

namespace novelview
{
/**
 * The arrangement of the cameras with their photographs in their frusta and points of the hull, seen
 * obliquely and from above, 1600 x 900. Cameras with findings are highlighted. Throws Error.
 */
void DrawCheckedCameras(const CheckReport& report, const std::filesystem::path& path);
}

#endif
