// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/Parallel.h"

#include "Threads.h"
#include "base/AddressSpace.h"

#include <opencv2/core.hpp>

#include <atomic>
#include <exception>
#include <vector>

namespace novelview
{
void ParallelForEach(std::size_t count, const std::function<void(std::size_t i)>& body,
  const std::function<void(double fraction)>& progress)
{
  std::atomic<std::size_t> done = 0;
  std::vector<std::exception_ptr> failures(count);
  ParallelFor(static_cast<std::int64_t>(count),
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        try
        {
          ThrowIfStopRequested();
          body(static_cast<std::size_t>(i));
          if (progress)
          {
            progress(static_cast<double>(++done) / static_cast<double>(count));
          }
        }
        catch (...)
        {
          failures[i] = std::current_exception();
        }
      }
    });
  for (const std::exception_ptr& failure : failures)
  {
    if (failure)
    {
      std::rethrow_exception(failure);
    }
  }
}

void LimitThreads(int threads)
{
  SetNumberOfThreads(threads);
  cv::setNumThreads(threads > 0 ? threads : -1);
  // Of TBB and OpenCV, which start them in the midst of work.
  RequireAddressSpace("threads", 2 * StackBytesOf(NumberOfThreads()));
}
}
