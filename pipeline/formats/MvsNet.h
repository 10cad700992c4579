// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MvsNet_h
#define novelview_MvsNet_h

#include "formats/DatasetFormats.h"

namespace novelview
{
/**
 * "mvsnet", a folder cams/ with a file NAME_cam.txt per photograph, which lies in images/ (or
 * blended_images/ or the folder) under NAME with any extension: the word "extrinsic" and [R t] of 4 x
 * 4, world to camera; the word "intrinsic" and K of 3 x 3; then depths, which are not read. Pixel
 * centres are whole numbers, as MVSNet takes them.
 */
DatasetFormat MvsNetFormat();
}

#endif
