// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_RenderCommand_h
#define novelview_RenderCommand_h

#include "base/Console.h"
#include "commands/RenderOptions.h"
#include "processes/ProcessGroup.h"

namespace novelview
{
/**
 * `novelview render`: many views from one hull and crust, into options.Out; shared out between the
 * processes. Throws Error, and Interrupted when the console requests a stop.
 */
void RenderViews(const RenderOptions& options, Console& console, ProcessGroup& processes);
}

#endif
