// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Parallel_h
#define novelview_Parallel_h

#include <cstddef>
#include <functional>

namespace novelview
{
/**
 * Calls body(i) for every i below `count`, spread over the threads that LimitThreads() allows.
 * When some of the calls throw, the exception of the lowest i is thrown on, at any thread count.
 * When StopRequested() (Threads.h), the rest is left and Interrupted thrown.
 * @param progress receives the fraction done, 0 to 1, in any thread.
 */
void ParallelForEach(std::size_t count, const std::function<void(std::size_t i)>& body,
  const std::function<void(double fraction)>& progress = {});

/**
 * Limits the threads of everything: filters, reading, OpenCV. 0 = one per core. Throws Error when
 * there is no memory for this many.
 */
void LimitThreads(int threads);
}

#endif
