// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef support_Expect_h
#define support_Expect_h

#include "core/Error.h"
#include "core/Execution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

namespace support
{
/** Expects the message of the Error that `body` throws to be a line that holds all of `expected`. */
template <class Body, class... Parts>
void ExpectError(const Body& body, const Parts&... expected)
{
  const std::vector<std::string> parts{ expected... };
  try
  {
    body();
    ADD_FAILURE() << "no error, expected one with: " << testing::PrintToString(parts);
  }
  catch (const novelview::Error& error)
  {
    const std::string text = error.what();
    for (const std::string& part : parts)
    {
      EXPECT_THAT(text, testing::HasSubstr(part));
    }
    EXPECT_EQ(text.find('\n'), std::string::npos) << "more than one line: " << text;
  }
}

/** Cuts every loop into pieces of uneven length that `count` threads work on at the same time. */
inline novelview::Execution InThreads(int count)
{
  novelview::Execution execution;
  execution.ParallelFor = [count](std::int64_t size, const novelview::Execution::RangeBody& body)
  {
    std::vector<std::thread> threads;
    for (int part = 0; part < count; ++part)
    {
      const std::int64_t begin = size * part * part / (count * count);
      const std::int64_t end = size * (part + 1) * (part + 1) / (count * count);
      if (begin < end)
      {
        threads.emplace_back([&body, begin, end] { body(begin, end); });
      }
    }
    for (std::thread& thread : threads)
    {
      thread.join();
    }
  };
  return execution;
}
}

#endif
