// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/Execution.h"

#include <gtest/gtest.h>

#include <mutex>
#include <numeric>
#include <thread>
#include <vector>

using namespace novelview;

namespace
{
/** Spreads every loop over two threads, the caller and another, as vtkSMPTools would. */
Execution OnTwoThreads()
{
  Execution execution;
  execution.ParallelFor = [](std::int64_t count, const Execution::RangeBody& body)
  {
    std::thread other([&] { body(count / 2, count); });
    body(0, count / 2);
    other.join();
  };
  return execution;
}

void Sleep(int milliseconds)
{
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}
}

TEST(Execution, ForEachCallsEveryBodyOnce)
{
  std::vector<int> calls(1000, 0);
  OnTwoThreads().ForEach(1000, [&](std::int64_t i) { ++calls[i]; });
  EXPECT_EQ(calls, std::vector<int>(1000, 1));
  Execution().ForEach(0, [](std::int64_t) { FAIL(); });
}

TEST(Execution, EveryPartOfALoopHasItsOwnScratch)
{
  std::vector<int> counted(10, 0);
  OnTwoThreads().ForEachWith(
    10, [] { return 0; }, [&](int& count, std::int64_t i) { counted[i] = ++count; });
  EXPECT_EQ(counted, (std::vector<int>{ 1, 2, 3, 4, 5, 1, 2, 3, 4, 5 }));
}

TEST(Execution, ReportStopsWhenTheListenerSaysSo)
{
  Execution execution;
  std::vector<double> heard;
  execution.Progress = [&](double fraction)
  {
    heard.push_back(fraction);
    return fraction < 0.5;
  };
  execution.Report(0.25);
  EXPECT_THROW(execution.Report(0.5), Interrupted);
  EXPECT_EQ(heard, (std::vector<double>{ 0.25, 0.5 }));
  EXPECT_THROW(execution.CheckCancelled(), Interrupted) << "who was told to stop stays so";
}

TEST(Execution, AStopReachesTheMiddleOfALoopOnEveryThread)
{
  Execution execution = OnTwoThreads();
  std::atomic<bool> stop = false;
  execution.StopRequested = [&] { return stop.load(); };
  std::atomic<int> calls = 0;
  const auto loop = [&]
  {
    execution.ForEach(20000,
      [&](std::int64_t)
      {
        stop = ++calls > 20;
        Sleep(1);
      });
  };
  EXPECT_THROW(loop(), Interrupted);
  // Threads look every few milliseconds.
  EXPECT_LT(calls, 200);
}

TEST(Execution, AStopReachesALongBodyThatTicks)
{
  Execution execution = OnTwoThreads();
  std::atomic<bool> stop = false;
  execution.StopRequested = [&] { return stop.load(); };
  std::atomic<int> ended = 0;
  const auto loop = [&]
  {
    execution.ForEach(2,
      [&](std::int64_t i)
      {
        for (int step = 0; step < 10000; ++step)
        {
          stop = stop || (i == 0 && step == 10);
          execution.CheckCancelled();
          Sleep(1);
        }
        ++ended;
      });
  };
  EXPECT_THROW(loop(), Interrupted);
  EXPECT_EQ(ended, 0);
}

TEST(Execution, TheListenerIsAskedInLongLoopsAndOnlyInItsOwnThread)
{
  Execution execution = OnTwoThreads();
  const std::thread::id own = std::this_thread::get_id();
  std::vector<double> heard;
  execution.Progress = [&](double fraction)
  {
    EXPECT_EQ(std::this_thread::get_id(), own);
    heard.push_back(fraction);
    return heard.size() < 3;
  };
  execution.Report(0.5);
  EXPECT_THROW(execution.ForEach(20000, [](std::int64_t) { Sleep(1); }), Interrupted);
  EXPECT_EQ(heard, (std::vector<double>{ 0.5, 0.5, 0.5 })) << "the fraction is the last one told";
}
