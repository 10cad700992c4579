// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PixelCentreCheck_h
#define novelview_PixelCentreCheck_h

#include "check/CheckContext.h"

namespace novelview
{
/** Claimed only when there can be no doubt; see README. */
void CheckPixelCentre(CheckContext& context);
}

#endif
