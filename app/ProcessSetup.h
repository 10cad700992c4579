// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ProcessSetup_h
#define novelview_ProcessSetup_h

namespace novelview
{
/**
 * Makes one line of error and exit code 1 of what is no exception that can be caught: lack of memory
 * (OutOfMemory.h), and exceptions that leave a thread or a destructor. VTK itself prints nothing.
 */
void SetUpProcess();
}

#endif
