// SPDX-License-Identifier: GPL-3.0-or-later
#include "Threads.h"

#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <set>
#include <thread>

using namespace novelview;

namespace
{
/** How many threads take part in a loop that lasts long enough for all to come. */
std::size_t ThreadsInLoop()
{
  std::mutex mutex;
  std::set<std::thread::id> threads;
  ParallelFor(100,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const std::lock_guard<std::mutex> lock(mutex);
        threads.insert(std::this_thread::get_id());
      }
    });
  return threads.size();
}
}

TEST(Threads, ALimitHoldsAgainAfterThereWasNone)
{
  SetNumberOfThreads(0);
  const int all = NumberOfThreads();
  for (int round = 0; round < 2; ++round)
  {
    SetNumberOfThreads(1);
    EXPECT_EQ(NumberOfThreads(), 1);
    EXPECT_EQ(ThreadsInLoop(), 1u);
    SetNumberOfThreads(0);
    EXPECT_EQ(NumberOfThreads(), all);
    EXPECT_LE(ThreadsInLoop(), static_cast<std::size_t>(all));
  }
}
