// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ExposureCheck_h
#define novelview_ExposureCheck_h

#include "check/CheckContext.h"

namespace novelview
{
/** Photographs that are less sharp, darker or brighter than the others, or clipped. */
void CheckExposure(CheckContext& context);
}

#endif
