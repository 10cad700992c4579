// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/FrameQueue.h"

#include <gtest/gtest.h>

#include <future>

using namespace novelview;
using namespace std::chrono_literals;
using Kind = FrameAnswer::Kind;

namespace
{
FrameRequest OfWidth(int width)
{
  FrameRequest request;
  request.Cam.Width = width;
  return request;
}

/** Asks from another thread, and returns once the request waits (the worker has not taken it). */
std::future<FrameAnswer> AskIn(FrameQueue& queue, int width)
{
  return std::async(std::launch::async, [&queue, width] { return queue.Ask(OfWidth(width)); });
}
}

TEST(FrameQueue, TheWorkerAnswersWhatItTook)
{
  FrameQueue queue;
  auto asked = AskIn(queue, 7);
  const auto ticket = queue.Take(10s);
  ASSERT_TRUE(ticket);
  EXPECT_EQ(ticket->Request.Cam.Width, 7);
  queue.Give(ticket, { Kind::Made, { 1, 2, 3 }, "" });
  const FrameAnswer answer = asked.get();
  EXPECT_EQ(answer.What, Kind::Made);
  EXPECT_EQ(answer.Png, (std::vector<std::uint8_t>{ 1, 2, 3 }));
  EXPECT_FALSE(queue.Take(1ms)) << "nothing waits";
}

TEST(FrameQueue, ANewerRequestReplacesTheWaitingOne)
{
  FrameQueue queue;
  auto first = AskIn(queue, 1);
  const auto atWork = queue.Take(10s); // the worker is busy with the first
  ASSERT_TRUE(atWork);
  std::vector<std::future<FrameAnswer>> drag;
  for (int width = 2; width <= 30; ++width)
  {
    drag.push_back(AskIn(queue, width));
    if (drag.size() > 1)
    {
      // Either of two may have come last; one of them is replaced.
      int replaced = 0;
      while (replaced == 0)
      {
        for (std::size_t i = 0; i < drag.size(); ++i)
        {
          if (drag[i].wait_for(1ms) == std::future_status::ready)
          {
            EXPECT_EQ(drag[i].get().What, Kind::Replaced);
            drag.erase(drag.begin() + static_cast<std::ptrdiff_t>(i));
            replaced = 1;
            break;
          }
        }
      }
    }
  }
  ASSERT_EQ(drag.size(), 1u) << "one waits";
  queue.Give(atWork, { Kind::Made, {}, "" });
  EXPECT_EQ(first.get().What, Kind::Made) << "what is at work is finished";
  const auto last = queue.Take(10s);
  ASSERT_TRUE(last);
  queue.Give(last, { Kind::Failed, {}, "why" });
  EXPECT_EQ(drag[0].get().Text, "why");
}

TEST(FrameQueue, ClosedItAnswersThoseWhoWaitAndThoseWhoCome)
{
  FrameQueue queue;
  auto waiting = AskIn(queue, 1);
  queue.Close();
  EXPECT_EQ(waiting.get().What, Kind::Closed);
  EXPECT_EQ(queue.Ask(OfWidth(2)).What, Kind::Closed);
}
