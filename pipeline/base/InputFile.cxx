// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/InputFile.h"

#include "base/OutOfMemory.h"
#include "core/Error.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <map>
#include <mutex>
#include <new>
#include <set>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/** Device and inode. */
using FileIdentity = std::pair<dev_t, ino_t>;

/** What the run reads and writes. */
struct KnownFiles
{
  std::map<FileIdentity, fs::path> Inputs;
  std::set<FileIdentity> Replaceable;         ///< inputs that may be replaced all the same
  std::map<FileIdentity, fs::path> Announced; ///< outputs that are there already
  std::set<fs::path> AnnouncedPaths;          ///< all outputs
  std::set<FileIdentity> Written;
};

std::mutex Guard;
bool Protecting = false;
KnownFiles Known;

std::string Reason(int number)
{
  return std::generic_category().message(number);
}

/** The path without links and without `..`, also where the file or its folder does not exist. */
fs::path Resolved(const fs::path& file)
{
  std::error_code failure;
  const fs::path absolute = fs::absolute(file, failure);
  const fs::path canonical = failure ? file : fs::weakly_canonical(absolute, failure);
  return failure ? file.lexically_normal() : canonical;
}

bool Identify(const fs::path& file, struct stat& status)
{
  return !file.empty() &&
    (::stat(file.c_str(), &status) == 0 || ::stat(Resolved(file).c_str(), &status) == 0);
}

FileIdentity IdentityOf(const struct stat& status)
{
  return { status.st_dev, status.st_ino };
}

std::string KindOf(const struct stat& status)
{
  if (S_ISDIR(status.st_mode))
  {
    return "a folder";
  }
  if (S_ISFIFO(status.st_mode))
  {
    return "a pipe";
  }
  return S_ISSOCK(status.st_mode) ? "a socket" : "a device";
}

[[noreturn]] void ThrowWouldReplace(const fs::path& output, const fs::path& input)
{
  const bool same = output == input;
  throw Error(output.string(),
    "would be replaced, but this run reads it" + (same ? std::string() : " as " + input.string()) +
      "; write to another place");
}

/** With Guard locked. */
void RememberInput(const fs::path& file, const struct stat& status)
{
  const FileIdentity identity = IdentityOf(status);
  if (Known.Written.count(identity) > 0)
  {
    return;
  }
  const auto output = Known.Announced.find(identity);
  if (output != Known.Announced.end() && Known.Replaceable.count(identity) == 0)
  {
    ThrowWouldReplace(output->second, file);
  }
  Known.Inputs.emplace(identity, file);
}

/** With Guard locked. */
void RefuseInput(const fs::path& file, const struct stat& status)
{
  const auto input = Known.Inputs.find(IdentityOf(status));
  if (input != Known.Inputs.end() && Known.Replaceable.count(input->first) == 0)
  {
    ThrowWouldReplace(file, input->second);
  }
}

/** A file that is open for reading. */
class OpenFile
{
public:
  explicit OpenFile(const fs::path& file)
    : File(file)
    // A pipe without a writer would block here.
    , Descriptor(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC))
  {
    if (this->Descriptor < 0)
    {
      throw Error(file.string(),
        errno == ENOENT || errno == ENOTDIR ? "cannot be read: no such file"
                                            : "cannot be read: " + Reason(errno));
    }
    struct stat status = {};
    if (::fstat(this->Descriptor, &status) != 0 || !S_ISREG(status.st_mode))
    {
      ::close(this->Descriptor);
      throw Error(file.string(), "is not a regular file", KindOf(status), "a regular file");
    }
    this->Size = static_cast<std::size_t>(status.st_size);
    try
    {
      const std::lock_guard lock(Guard);
      if (Protecting)
      {
        RememberInput(file, status);
      }
    }
    catch (...)
    {
      ::close(this->Descriptor);
      throw;
    }
  }
  ~OpenFile() { ::close(this->Descriptor); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  /** As many bytes as there are, `most` at most. */
  std::string Read(std::size_t most)
  {
    try
    {
      const OutOfMemoryIsCaught caught;
      // Some files, such as those of /proc, have no known size.
      std::string bytes;
      bytes.reserve(std::min(this->Size + 1, most));
      std::size_t count = 0;
      do
      {
        constexpr std::size_t block = 1 << 16;
        bytes.resize(std::min(most, std::max(bytes.capacity(), count + block)));
        const ssize_t got = ::read(this->Descriptor, bytes.data() + count, bytes.size() - count);
        if (got < 0 && errno != EINTR)
        {
          throw Error(this->File.string(), "cannot be read: " + Reason(errno));
        }
        if (got == 0)
        {
          break;
        }
        count += got > 0 ? static_cast<std::size_t>(got) : 0;
      } while (count < most);
      bytes.resize(count);
      return bytes;
    }
    catch (const std::bad_alloc&)
    {
      throw Error(this->File.string(), "is too large for the memory",
        std::to_string(this->Size) + " bytes", "fewer");
    }
  }

private:
  fs::path File;
  int Descriptor;
  std::size_t Size = 0;
};
}

InputProtection::InputProtection()
{
  const std::lock_guard lock(Guard);
  Known = {};
  Protecting = true;
}

InputProtection::~InputProtection()
{
  const std::lock_guard lock(Guard);
  Protecting = false;
}

std::string ReadInputFile(const fs::path& file)
{
  return OpenFile(file).Read(std::string().max_size() / 2);
}

std::string ReadInputText(const fs::path& file)
{
  std::string text = ReadInputFile(file);
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
  {
    throw Error(file.string(), "text has the wrong encoding", "UTF-16", "UTF-8");
  }
  return text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
}

std::string ReadInputStart(const fs::path& file, std::size_t count)
{
  return OpenFile(file).Read(count);
}

void ProtectInput(const fs::path& file)
{
  struct stat status = {};
  const std::lock_guard lock(Guard);
  if (Protecting && Identify(file, status))
  {
    RememberInput(file, status);
  }
}

void AnnounceOutput(const fs::path& file)
{
  RequireReplaceable(file);
  struct stat status = {};
  const std::lock_guard lock(Guard);
  if (!Protecting)
  {
    return;
  }
  if (!Known.AnnouncedPaths.insert(Resolved(file)).second)
  {
    throw Error(file.string(), "would be written twice; two results have this name");
  }
  if (Identify(file, status))
  {
    Known.Announced.emplace(IdentityOf(status), file);
  }
}

bool IsInput(const fs::path& file)
{
  struct stat status = {};
  const std::lock_guard lock(Guard);
  return Protecting && Identify(file, status) && Known.Inputs.count(IdentityOf(status)) > 0 &&
    Known.Replaceable.count(IdentityOf(status)) == 0;
}

void RequireReplaceable(const fs::path& file)
{
  struct stat status = {};
  if (!Identify(file, status))
  {
    return;
  }
  if (!S_ISREG(status.st_mode))
  {
    throw Error(
      file.string(), "cannot be replaced by a file", KindOf(status), "a file, or nothing there");
  }
  const std::lock_guard lock(Guard);
  if (Protecting)
  {
    RefuseInput(file, status);
  }
}

void NoteWritten(const fs::path& file)
{
  struct stat status = {};
  const std::lock_guard lock(Guard);
  if (Protecting && Identify(file, status))
  {
    Known.Written.insert(IdentityOf(status));
  }
}

void AllowReplacing(const fs::path& file)
{
  struct stat status = {};
  const std::lock_guard lock(Guard);
  if (Protecting && Identify(file, status))
  {
    Known.Replaceable.insert(IdentityOf(status));
  }
}
}
