// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/OutOfMemory.h"

#include "base/StderrSilence.h"

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>
#include <sys/uio.h>
#include <unistd.h>

namespace novelview
{
namespace
{
thread_local int Catching = 0;

void OnNoMemory()
{
  if (Catching > 0)
  {
    throw std::bad_alloc();
  }
  EndWithError("out of memory");
}
}

void EndWhenOutOfMemory()
{
  std::set_new_handler(OnNoMemory);
}

OutOfMemoryIsCaught::OutOfMemoryIsCaught()
{
  ++Catching;
}

OutOfMemoryIsCaught::~OutOfMemoryIsCaught()
{
  --Catching;
}

void PrintLastError(const char* text)
{
  const auto part = [](const char* bytes)
  {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): writev() only reads
    return iovec{ const_cast<char*>(bytes), std::strlen(bytes) };
  };
  const iovec line[] = { part("novelview: error: "), part(text), part("\n") };
  [[maybe_unused]] const ssize_t written = ::writev(LoudStderr(), line, 3);
}

void EndWithError(const char* text)
{
  // Several threads may come here; the first one speaks.
  static std::atomic_flag ending = ATOMIC_FLAG_INIT;
  while (ending.test_and_set())
  {
    ::pause();
  }
  PrintLastError(text);
  // Other threads still run; nothing of theirs shall be waited for or torn down.
  ::_exit(EXIT_FAILURE);
}
}
