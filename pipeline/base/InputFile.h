// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * The files that a run reads, and the promise that none of them is replaced by what the same run
 * writes. Files are distinguished by device and inode, so that a link to a photograph is the
 * photograph. Readers get their bytes from here; writers check here (see AtomicFile.h).
 *
 * Inputs are protected while an InputProtection exists; without one nothing is remembered, so that
 * other programs may use the readers and writers as they like. Every function may be called by
 * several threads at once.
 */
#ifndef novelview_InputFile_h
#define novelview_InputFile_h

#include <cstddef>
#include <filesystem>
#include <string>

namespace novelview
{
/** While an object of this class exists, inputs are remembered and protected. One at a time. */
class InputProtection
{
public:
  InputProtection();
  ~InputProtection();
  InputProtection(const InputProtection&) = delete;
  InputProtection& operator=(const InputProtection&) = delete;
};

/**
 * The bytes of a file, which becomes an input. Throws Error, naming it, when there is none, when it
 * is not a regular file (a pipe or a device might never end), and when it cannot be read.
 */
std::string ReadInputFile(const std::filesystem::path& file);

/** The same of a text, without the byte-order mark of UTF-8; UTF-16 is an Error. */
std::string ReadInputText(const std::filesystem::path& file);

/** The same for the first bytes, `count` or as many as there are. */
std::string ReadInputStart(const std::filesystem::path& file, std::size_t count);

/**
 * Makes a file an input that is only named so far, or read by others. Nothing is done when there is
 * none. Throws Error when it has been announced as an output.
 */
void ProtectInput(const std::filesystem::path& file);

/**
 * Announces that a file will be written. Throws Error as RequireReplaceable() does, and when it is
 * announced already.
 */
void AnnounceOutput(const std::filesystem::path& file);

/** Whether a file is an input that may not be replaced. */
bool IsInput(const std::filesystem::path& file);

/** Throws Error when a file, which is about to be written, is an input, or no regular file. */
void RequireReplaceable(const std::filesystem::path& file);

/** Records that a file has been written; reading it from now on does not make it an input. */
void NoteWritten(const std::filesystem::path& file);

/** The exception to the promise: this input may be replaced, once its new contents are whole. */
void AllowReplacing(const std::filesystem::path& file);
}

#endif
