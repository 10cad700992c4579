// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ConventionCheck_h
#define novelview_ConventionCheck_h

#include "check/CheckContext.h"

namespace novelview
{
/**
 * Finds the convention with which the silhouettes agree, and the masks' polarity; reads the data set
 * so, and reports it when that is not how it was read.
 */
void CheckConvention(CheckContext& context);
}

#endif
