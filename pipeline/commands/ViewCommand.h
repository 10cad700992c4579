// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ViewCommand_h
#define novelview_ViewCommand_h

#include "base/Console.h"
#include "commands/ViewOptions.h"

namespace novelview
{
/** `novelview view`: serves a page with novel views until it is interrupted. Throws Error. */
void ServeView(const ViewOptions& options, Console& console);
}

#endif
