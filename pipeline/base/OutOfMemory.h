// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OutOfMemory_h
#define novelview_OutOfMemory_h

namespace novelview
{
/**
 * From now on this process ends at once, with one line of error and exit code 1, when `new` gets no
 * memory in any thread: VTK and other libraries do not survive the exception. For programs.
 */
void EndWhenOutOfMemory();

/** While one lives, its thread gets the exception, std::bad_alloc, and its owner catches it. */
class OutOfMemoryIsCaught
{
public:
  OutOfMemoryIsCaught();
  ~OutOfMemoryIsCaught();
  OutOfMemoryIsCaught(const OutOfMemoryIsCaught&) = delete;
  void operator=(const OutOfMemoryIsCaught&) = delete;
};

/** Prints one line of error from any thread, bypassing the console; allocates no memory. */
void PrintLastError(const char* text);

/** The same, and ends the process with exit code 1. */
[[noreturn]] void EndWithError(const char* text);
}

#endif
