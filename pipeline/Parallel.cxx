// SPDX-License-Identifier: GPL-3.0-or-later
#include "Parallel.h"

#include "Error.h"
#include "Threads.h"

#include <opencv2/core.hpp>

#include <exception>
#include <vector>

namespace novelview
{
void ParallelForEach(std::size_t count, const std::function<void(std::size_t i)>& body)
{
  std::vector<std::exception_ptr> failures(count);
  ParallelFor(static_cast<std::int64_t>(count),
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        try
        {
          if (StopRequested())
          {
            throw Interrupted();
          }
          body(static_cast<std::size_t>(i));
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
}
}
