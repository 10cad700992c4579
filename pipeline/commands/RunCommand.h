// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_RunCommand_h
#define novelview_RunCommand_h

#include "base/Console.h"
#include "commands/RunOptions.h"

namespace novelview
{
/**
 * `novelview run`: one novel view with everything that is reported about it, into options.Out.
 * Throws Error, and Interrupted when the console requests a stop.
 */
void RunView(const RunOptions& options, Console& console);
}

#endif
