// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MaskCheck_h
#define novelview_MaskCheck_h

#include "check/CheckContext.h"

namespace novelview
{
/** Photographs without a mask, and masks without a photograph. */
void CheckMasks(CheckContext& context);
}

#endif
