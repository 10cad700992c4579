// SPDX-License-Identifier: GPL-3.0-or-later
/** The orientation tag that a camera writes into a photograph's EXIF data. */
#ifndef novelview_ExifOrientation_h
#define novelview_ExifOrientation_h

#include <filesystem>

namespace novelview
{
/**
 * How a picture has to be turned to stand upright: 1 = not at all, 3 = by 180 degrees, 6 = by 90
 * degrees clockwise, 8 = by 270; 2, 4, 5 and 7 also mirror it. 1 where a JPEG or PNG file has no tag,
 * and for other files, whose tags nobody uses.
 */
int ReadExifOrientation(const std::filesystem::path& file);

/** Whether an orientation exchanges width and height. */
inline bool SwapsSides(int orientation)
{
  return orientation >= 5;
}
}

#endif
