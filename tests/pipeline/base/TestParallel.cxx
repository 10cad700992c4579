// SPDX-License-Identifier: GPL-3.0-or-later
#include "Threads.h"
#include "base/Parallel.h"

#include <opencv2/core.hpp>

#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <set>
#include <thread>

using namespace novelview;

namespace
{
/** The threads that run the bodies of a loop. Each body takes long enough for all to take part. */
std::size_t ThreadsOfLoop(const std::function<void(const std::function<void()>& body)>& loop)
{
  std::mutex mutex;
  std::set<std::thread::id> threads;
  loop(
    [&]
    {
      {
        const std::lock_guard lock(mutex);
        threads.insert(std::this_thread::get_id());
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    });
  return threads.size();
}

std::size_t ThreadsOfLoops()
{
  return ThreadsOfLoop(
    [](const auto& body) { ParallelForEach(64, [&body](std::size_t) { body(); }); });
}

std::size_t ThreadsOfOpenCv()
{
  return ThreadsOfLoop(
    [](const auto& body)
    {
      cv::parallel_for_(cv::Range(0, 64),
        [&body](const cv::Range& range)
        {
          for (int i = range.start; i < range.end; ++i)
          {
            body();
          }
        });
    });
}

/** Restores the default at the end of a test. */
class Parallel : public testing::Test
{
protected:
  ~Parallel() override { LimitThreads(0); }
};
}

TEST_F(Parallel, LimitThreadsLimitsLoopsAndOpenCv)
{
  LimitThreads(1);
  EXPECT_EQ(NumberOfThreads(), 1);
  EXPECT_EQ(cv::getNumThreads(), 1);
  EXPECT_EQ(ThreadsOfLoops(), 1u);
  EXPECT_EQ(ThreadsOfOpenCv(), 1u);

  LimitThreads(2);
  EXPECT_EQ(NumberOfThreads(), 2);
  EXPECT_EQ(cv::getNumThreads(), 2);
  EXPECT_LE(ThreadsOfLoops(), 2u);
  EXPECT_LE(ThreadsOfOpenCv(), 2u);
}

TEST_F(Parallel, ZeroMeansOneThreadPerCore)
{
  LimitThreads(0);
  const int before = NumberOfThreads();
  const int beforeOfOpenCv = cv::getNumThreads();
  LimitThreads(1);
  LimitThreads(0);
  EXPECT_EQ(NumberOfThreads(), before);
  EXPECT_EQ(cv::getNumThreads(), beforeOfOpenCv);
}
