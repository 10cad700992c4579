// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OrientationCheck_h
#define novelview_OrientationCheck_h

#include "check/CheckContext.h"

namespace novelview
{
/** Where sizes and masks do not tell whether EXIF orientation tags are applied: whether the silhouettes
 * agree only when they are. */
void CheckOrientation(CheckContext& context);
}

#endif
