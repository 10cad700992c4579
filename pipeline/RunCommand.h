// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_RunCommand_h
#define novelview_RunCommand_h

#include "Console.h"
#include "Job.h"
#include "ProcessGroup.h"

namespace novelview
{
/**
 * `novelview run`: one novel view with everything that is reported about it, into job.Out. Throws
 * Error, and Interrupted when the console asks for a stop.
 */
void RunJob(const Job& job, Console& console);

/**
 * `novelview render`: many views from one hull and crust, into options.Out; shared out between the
 * processes. Throws the same.
 */
void RenderJob(const RenderOptions& options, Console& console, ProcessGroup& processes);
}

#endif
