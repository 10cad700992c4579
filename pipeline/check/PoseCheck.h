// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PoseCheck_h
#define novelview_PoseCheck_h

#include "check/CheckContext.h"

namespace novelview
{
/**
 * Whether the photographs agree better with other poses (see RefinedCameras.h), at reduced size: a
 * camera far more off than the others is named, and a note has the mean and the largest shift.
 */
void CheckPoses(CheckContext& context);
}

#endif
