// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_AgreementCheck_h
#define novelview_AgreementCheck_h

#include "check/CheckContext.h"

namespace novelview
{
/** Views whose silhouettes do not agree with the others. */
void CheckAgreement(CheckContext& context);
}

#endif
