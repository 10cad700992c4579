// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/TemporaryFile.h"

#include "core/Error.h"

#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <mutex>
#include <set>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
constexpr const char* Prefix = ".novelview-tmp.";

/** Removes a file that a killed run has left: one that is not locked. */
void RemoveIfLeft(const fs::path& file)
{
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0)
  {
    return;
  }
  struct stat status = {};
  if (::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
    ::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
  {
    ::unlink(file.c_str());
  }
  ::close(descriptor);
}

/** The first time that this process writes into a folder, what others have left there goes. */
void RemoveLeftFiles(const fs::path& folder)
{
  static std::mutex guard;
  static std::set<fs::path> seen;
  const std::lock_guard lock(guard);
  if (!seen.insert(folder).second)
  {
    return;
  }
  std::error_code failure;
  fs::directory_iterator entry(folder, failure);
  while (!failure && entry != fs::directory_iterator())
  {
    if (entry->path().filename().string().rfind(Prefix, 0) == 0)
    {
      RemoveIfLeft(entry->path());
    }
    entry.increment(failure);
  }
}

fs::path FolderOf(const fs::path& file)
{
  const fs::path folder = file.parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

void MakeFolder(const fs::path& folder)
{
  std::error_code failure;
  fs::create_directories(folder, failure);
  // A link to a folder is one, though create_directories() may say otherwise.
  std::error_code ignored;
  if (failure && !fs::is_directory(folder, ignored))
  {
    throw Error(folder.string(), "cannot make the folder: " + failure.message());
  }
}
}

TemporaryFile::TemporaryFile(const fs::path& target)
  : Target(target)
{
  const fs::path folder = FolderOf(target);
  MakeFolder(folder);
  RemoveLeftFiles(folder);
  int attempt = 0;
  while (!this->Create(attempt++))
  {
    if (attempt == 100)
    {
      this->Fail(errno);
    }
  }
}

TemporaryFile::~TemporaryFile()
{
  if (this->Descriptor >= 0)
  {
    ::unlink(this->Temporary.c_str());
    ::close(this->Descriptor);
  }
}

/** False when the name is taken, or the file was removed before it was locked. */
bool TemporaryFile::Create(int attempt)
{
  static std::atomic<unsigned> count = 0;
  this->Temporary = FolderOf(this->Target) /
    (Prefix + std::to_string(::getpid()) + "." + std::to_string(count++) +
      this->Target.extension().string());
  constexpr mode_t everybody = 0666; // less what the user's umask takes away
  this->Descriptor =
    ::open(this->Temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, everybody);
  if (this->Descriptor < 0)
  {
    if (errno != EEXIST || attempt > 50)
    {
      this->Fail(errno);
    }
    return false;
  }
  // On a file system without locks the file is not locked; then it is not removed either.
  struct stat status = {};
  if (::flock(this->Descriptor, LOCK_EX) == 0 && ::fstat(this->Descriptor, &status) == 0 &&
    status.st_nlink == 0)
  {
    ::close(this->Descriptor);
    this->Descriptor = -1;
    return false;
  }
  return true;
}

void TemporaryFile::Write(std::string_view bytes)
{
  while (!bytes.empty())
  {
    const ssize_t written = ::write(this->Descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR)
    {
      this->Fail(errno);
    }
    bytes.remove_prefix(written > 0 ? static_cast<std::size_t>(written) : 0);
  }
}

void TemporaryFile::Commit()
{
  // Some file systems cannot synchronise; they say EINVAL.
  if (::fsync(this->Descriptor) != 0 && errno != EINVAL && errno != EROFS)
  {
    this->Fail(errno);
  }
  if (::rename(this->Temporary.c_str(), this->Target.c_str()) != 0)
  {
    this->Fail(errno);
  }
  const int descriptor = this->Descriptor;
  this->Descriptor = -1;
  if (::close(descriptor) != 0 && errno != EINTR)
  {
    this->Fail(errno);
  }
}

void TemporaryFile::Fail(int reason) const
{
  throw Error(
    this->Target.string(), "cannot be written: " + std::generic_category().message(reason));
}
}
