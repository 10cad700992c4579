// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Atomic writing of files: the bytes go into a temporary file beside the target, to
 * the disk, and then into the target's place. A run that fails, is interrupted or killed leaves the
 * file that was there before. Missing folders are made.
 *
 * Every function throws Error, naming the target, when the disk is full, when the target is no
 * regular file, or when it is a file that this run has read (InputFile.h); and, before anything is
 * done, Interrupted when StopRequested() (Threads.h).
 */
#ifndef novelview_AtomicFile_h
#define novelview_AtomicFile_h

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace novelview
{
/**
 * Writes bytes, text or binary. An input of the run that already contains exactly these bytes stays
 * as it is.
 */
void WriteTextAtomically(const std::filesystem::path& path, std::string_view bytes);

/** The same for files that a stop must not lose: does not check for a requested stop. */
void WriteDespiteStop(const std::filesystem::path& path, std::string_view bytes);

/**
 * For writers that want a file: calls `write` with the path of the temporary file, which has the
 * target's extension. `write` returns false or throws when it could not write.
 */
void WriteAtomically(const std::filesystem::path& path,
  const std::function<bool(const std::filesystem::path& temporary)>& write);

/**
 * AnnounceOutput() (InputFile.h) for a file whose bytes are known already: an input that holds just
 * these may be written.
 */
void AnnounceText(const std::filesystem::path& path, std::string_view bytes);

/** Proves that files can be written into a folder, which is made when it is missing. */
void RequireWritable(const std::filesystem::path& folder);
}

#endif
