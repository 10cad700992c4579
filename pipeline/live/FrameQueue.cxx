// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/FrameQueue.h"

#include <utility>

namespace novelview
{
FrameAnswer FrameQueue::Ask(const FrameRequest& request)
{
  const auto ticket = std::make_shared<Ticket>();
  ticket->Request = request;
  std::unique_lock lock(this->Mutex);
  if (this->Next)
  {
    this->Next->Answer.What = FrameAnswer::Kind::Replaced;
  }
  this->Next = ticket;
  this->Changed.notify_all();
  this->Changed.wait(
    lock, [&] { return this->Ended || ticket->Answer.What != FrameAnswer::Kind::Waiting; });
  if (ticket->Answer.What == FrameAnswer::Kind::Waiting)
  {
    ticket->Answer.What = FrameAnswer::Kind::Closed;
  }
  return std::move(ticket->Answer);
}

std::shared_ptr<FrameQueue::Ticket> FrameQueue::Take(std::chrono::milliseconds patience)
{
  std::unique_lock lock(this->Mutex);
  this->Changed.wait_for(lock, patience, [&] { return this->Next != nullptr; });
  return std::exchange(this->Next, nullptr);
}

void FrameQueue::Give(const std::shared_ptr<Ticket>& ticket, FrameAnswer answer)
{
  const std::lock_guard lock(this->Mutex);
  ticket->Answer = std::move(answer);
  this->Changed.notify_all();
}

void FrameQueue::Close()
{
  const std::lock_guard lock(this->Mutex);
  this->Ended = true;
  this->Changed.notify_all();
}
}
