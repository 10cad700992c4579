// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_FrameQueue_h
#define novelview_FrameQueue_h

#include "live/FrameRequest.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace novelview
{
/** What became of a request. */
struct FrameAnswer
{
  enum class Kind
  {
    Waiting,
    Made,     ///< Png is the picture
    Replaced, ///< a newer request took its place
    Failed,   ///< Text is the error
    Closed    ///< the program ends
  };
  Kind What = Kind::Waiting;
  std::vector<std::uint8_t> Png;
  std::string Text;
  std::optional<Eigen::Vector3d> Point; ///< of the surface at the pixel to pick
};

/**
 * Requests of many threads for one worker. At most one request waits: a newer one replaces it. So
 * memory is bounded, and the worker is never more than one picture behind.
 */
class FrameQueue
{
public:
  struct Ticket
  {
    FrameRequest Request;
    FrameAnswer Answer;
  };

  /** Waits until the request has been answered. */
  FrameAnswer Ask(const FrameRequest& request);

  /** For the worker: the waiting request, or null when there was none for `patience`. */
  std::shared_ptr<Ticket> Take(std::chrono::milliseconds patience);
  /** For the worker: answers what it took. */
  void Give(const std::shared_ptr<Ticket>& ticket, FrameAnswer answer);

  /** Answers everything, now and later, with Closed. */
  void Close();

private:
  std::mutex Mutex;
  std::condition_variable Changed;
  std::shared_ptr<Ticket> Next; ///< waits for the worker; null = none
  bool Ended = false;
};
}

#endif
