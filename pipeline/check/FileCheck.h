// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_FileCheck_h
#define novelview_FileCheck_h

#include "check/CheckContext.h"

namespace novelview
{
/** Files that cannot be read, masks that say nothing, objects that leave the frame, too few views. */
void CheckFiles(CheckContext& context);
}

#endif
