// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_LiveServer_h
#define novelview_LiveServer_h

#include "live/FrameQueue.h"

#include <memory>
#include <string>
#include <vector>

namespace novelview
{
/**
 * The web server of the page. Every request needs the token, a Host that names this computer, and,
 * where there is an Origin, the page's own. Requests are bounded in size and time.
 *
 *   GET  /?token=T  the page
 *   GET  /state     JSON that SetState() gave
 *   GET  /photograph?number=N  a thumbnail that SetThumbnails() gave; 404 when there is none
 *   POST /frame     a FrameRequest as JSON; 200 and a PNG, with the point to pick in the header
 *                   X-Point; 409 when replaced, 422 with an error
 *
 * All but the page take the token from the header X-Token. Other answers: 400 (malformed), 403
 * (token, Host, Origin), 503 (the program ends).
 */
class LiveServer
{
public:
  static constexpr std::size_t LargestBodyBytes = 4096;

  /** Listens; port 0 = any that is free. Throws Error when that is impossible. */
  LiveServer(const std::string& address, int port);
  /** Ends the server; every waiting request is answered. */
  ~LiveServer();

  int Port() const;
  const std::string& Token() const;
  /** The address of the page. */
  std::string Address() const;

  /** What GET /state answers. */
  void SetState(std::string json);
  /** What GET /photograph answers, JPEG files by the number of the photograph. */
  void SetThumbnails(std::vector<std::vector<std::uint8_t>> jpegs);
  FrameQueue& Frames();

private:
  class Internals;
  std::unique_ptr<Internals> Impl;
};
}

#endif
