// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_AtomicFile_h
#define novelview_AtomicFile_h

#include <filesystem>
#include <functional>
#include <string>

namespace novelview
{
/**
 * Calls `write` with a temporary path beside `path` (same extension) and renames the result to
 * `path`, so that a failed or interrupted run leaves no half-written file. `write` returns false or
 * throws when it could not write. Missing folders are made. Throws Error, naming `path`, and, before
 * anything is done, Interrupted when StopRequested() (Threads.h).
 */
void WriteAtomically(const std::filesystem::path& path,
  const std::function<bool(const std::filesystem::path& temporary)>& write);

/** The same for text. */
void WriteTextAtomically(const std::filesystem::path& path, const std::string& text);
}

#endif
