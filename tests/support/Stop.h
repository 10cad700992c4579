// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef support_Stop_h
#define support_Stop_h

#include "Threads.h"

#include <atomic>

namespace support
{
/** The flag that StopRequested() reads, for as long as this lives. */
class Stop
{
public:
  Stop() { novelview::SetStopFlag(&this->Flag); }
  ~Stop() { novelview::SetStopFlag(nullptr); }
  Stop(const Stop&) = delete;
  Stop& operator=(const Stop&) = delete;

  std::atomic<bool> Flag = false;
};
}

#endif
