// SPDX-License-Identifier: GPL-3.0-or-later
// The one place that includes vtkSMPTools: VTK 9.1's header does not compile as C++20, so its source
// file is compiled as C++17.
#ifndef novelview_Threads_h
#define novelview_Threads_h

#include "vtkNovelViewFiltersModule.h"

#include <atomic>
#include <cstdint>
#include <functional>

namespace novelview
{
/** vtkSMPTools::For over [0, count). */
VTKNOVELVIEWFILTERS_EXPORT void ParallelFor(
  std::int64_t count, const std::function<void(std::int64_t begin, std::int64_t end)>& body);

/** How many threads ParallelFor uses from now on; 0 = one per core. */
VTKNOVELVIEWFILTERS_EXPORT void SetNumberOfThreads(int count);

/** How many it is estimated to use. */
VTKNOVELVIEWFILTERS_EXPORT int NumberOfThreads();

/**
 * A flag that makes every filter stop in the middle of its work, like AbortExecute, but for signal
 * handlers: it is read by all threads and often. Null (none) by default; must outlive its use.
 */
VTKNOVELVIEWFILTERS_EXPORT void SetStopFlag(const std::atomic<bool>* flag);

/** Whether the flag is there and set. */
VTKNOVELVIEWFILTERS_EXPORT bool StopRequested();

/** Throws Interrupted when StopRequested(). */
VTKNOVELVIEWFILTERS_EXPORT void ThrowIfStopRequested();
}

#endif
