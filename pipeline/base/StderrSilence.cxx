// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/StderrSilence.h"

#include <atomic>
#include <cstdio>
#include <fcntl.h>
#include <mutex>
#include <unistd.h>

namespace novelview
{
namespace
{
std::mutex Guard;
int Users = 0;
std::atomic<int> Kept =
  -1; ///< the real standard error while there are users; -1 = could not be kept
}

StderrSilence::StderrSilence()
{
  const std::lock_guard lock(Guard);
  if (Users++ > 0)
  {
    return;
  }
  std::fflush(stderr);
  Kept = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (Kept >= 0 && nowhere >= 0)
  {
    ::dup2(nowhere, STDERR_FILENO);
  }
  if (nowhere >= 0)
  {
    ::close(nowhere);
  }
}

StderrSilence::~StderrSilence()
{
  const std::lock_guard lock(Guard);
  if (--Users > 0 || Kept < 0)
  {
    return;
  }
  std::fflush(stderr);
  ::dup2(Kept, STDERR_FILENO);
  ::close(Kept.exchange(-1));
}

int LoudStderr()
{
  const int kept = Kept;
  return kept >= 0 ? kept : STDERR_FILENO;
}
}
