// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SystemMemory_h
#define novelview_SystemMemory_h

namespace novelview
{
/** The memory that programs can still have without swapping, bytes; 0 where the system does not say. */
double AvailableMemory();
}

#endif
