// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the pipeline's sources.
#ifndef novelview_TemporaryFile_h
#define novelview_TemporaryFile_h

#include <filesystem>
#include <string_view>

namespace novelview
{
/**
 * A file beside the one that is to be written, named `.novelview-tmp.` and so on, which takes the
 * other's place once it is whole. It is locked while it is in use; what runs that were killed have
 * left in the folder is not, and is removed.
 */
class TemporaryFile
{
public:
  /** Throws Error, naming the target. Missing folders are made. */
  explicit TemporaryFile(const std::filesystem::path& target);
  /** Removes the file when it has not taken its place. */
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  /** With the target's extension, since writers choose the format by it. */
  const std::filesystem::path& Path() const { return this->Temporary; }

  /** Adds bytes. Throws Error when not all of them can be written. */
  void Write(std::string_view bytes);

  /** Brings the file to the disk and puts it in the target's place. Throws Error. */
  void Commit();

private:
  bool Create(int attempt);
  [[noreturn]] void Fail(int reason) const;

  std::filesystem::path Target;
  std::filesystem::path Temporary;
  int Descriptor = -1;
};
}

#endif
