// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis/CacheFile.h"

#include "base/ByteStream.h"
#include "core/Error.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
constexpr std::string_view MagicBytes = "NVCACHE\n";
constexpr std::uint32_t CurrentVersion = 1;
constexpr std::size_t ChecksumBytes = sizeof(std::uint64_t);

/** What stands before everything whose length is not fixed. */
struct Start
{
  std::array<char, MagicBytes.size()> Magic{};
  std::uint32_t Version = 0;
  std::uint32_t SectionCount = 0;
  std::uint64_t DirectoryLength = 0;
};
static_assert(sizeof(Start) == 24, "no byte of padding, which would be under no checksum");

std::uint64_t Checksum(std::string_view bytes)
{
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::string SystemText()
{
  return std::system_category().message(errno);
}
}

std::string ComposeCacheFile(const std::string& key, std::vector<SceneSection> sections)
{
  ByteWriter entries;
  entries.AddText(key);
  std::size_t bytes = 0;
  for (const SceneSection& section : sections)
  {
    entries.AddText(section.Name);
    entries.Add<std::uint64_t>(section.Bytes.size());
    entries.Add(Checksum(section.Bytes));
    bytes += section.Bytes.size();
  }
  Start start;
  std::copy(MagicBytes.begin(), MagicBytes.end(), start.Magic.begin());
  start.Version = CurrentVersion;
  start.SectionCount = static_cast<std::uint32_t>(sections.size());
  start.DirectoryLength = sizeof(Start) + entries.Written.size() + ChecksumBytes;
  ByteWriter file;
  file.Written.reserve(start.DirectoryLength + bytes);
  file.Add(start);
  file.AddBytes(entries.Written.data(), entries.Written.size());
  file.Add(Checksum(file.Written));
  for (SceneSection& section : sections)
  {
    const std::string taken = std::move(section.Bytes);
    file.AddBytes(taken.data(), taken.size());
  }
  return std::move(file.Written);
}

CacheFile::CacheFile(const fs::path& path, const std::string& key)
  : Path(path)
  // Not to wait, should there be a FIFO.
  , Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK))
{
  if (this->Descriptor < 0)
  {
    throw Error(path.string(), "cannot be read: " + SystemText());
  }
  try
  {
    this->ReadDirectory(key);
  }
  catch (...)
  {
    ::close(this->Descriptor);
    throw;
  }
}

CacheFile::~CacheFile()
{
  ::close(this->Descriptor);
}

bool CacheFile::Exists(const fs::path& path)
{
  struct stat status;
  return ::stat(path.c_str(), &status) == 0 || (errno != ENOENT && errno != ENOTDIR);
}

void CacheFile::ReadDirectory(const std::string& key)
{
  const std::string where = this->Path.string();
  struct stat status = {};
  if (::fstat(this->Descriptor, &status) != 0 || !S_ISREG(status.st_mode))
  {
    throw Error(where, "is not a regular file");
  }
  this->Size = static_cast<std::uint64_t>(status.st_size);
  const std::string directory = this->CheckedDirectory();
  ByteReader reader(directory, where);
  const auto start = reader.Take<Start>();
  if (reader.TakeText() != key)
  {
    throw Error(where, "is the cache file of something else");
  }
  std::uint64_t offset = start.DirectoryLength;
  for (std::uint32_t i = 0; i < start.SectionCount; ++i)
  {
    Entry entry;
    entry.Name = reader.TakeText();
    entry.Length = reader.Take<std::uint64_t>();
    entry.Checksum = reader.Take<std::uint64_t>();
    entry.Offset = offset;
    if (entry.Length > this->Size - offset)
    {
      throw Error(where, "is too short", std::to_string(this->Size) + " bytes", "more");
    }
    offset += entry.Length;
    this->Entries.push_back(std::move(entry));
  }
  reader.RequireEnd();
  if (offset != this->Size)
  {
    throw Error(
      where, "is too long", std::to_string(this->Size) + " bytes", std::to_string(offset));
  }
}

/** The directory's bytes without its checksum, which is correct. */
std::string CacheFile::CheckedDirectory() const
{
  const std::string where = this->Path.string();
  constexpr std::size_t least = sizeof(Start) + ChecksumBytes;
  if (this->Size < least)
  {
    throw Error(where, "is too short", std::to_string(this->Size) + " bytes",
      "at least " + std::to_string(least));
  }
  const auto start = ByteReader(this->ReadBytes(0, sizeof(Start)), where).Take<Start>();
  if (!std::equal(MagicBytes.begin(), MagicBytes.end(), start.Magic.begin()) ||
    start.Version != CurrentVersion)
  {
    throw Error(where, "is not a cache file of this version");
  }
  if (start.DirectoryLength < least || start.DirectoryLength > this->Size)
  {
    throw Error(where, "the length of its directory is wrong");
  }
  std::string directory = this->ReadBytes(0, start.DirectoryLength - ChecksumBytes);
  const std::string checksum =
    this->ReadBytes(start.DirectoryLength - ChecksumBytes, ChecksumBytes);
  if (ByteReader(checksum, where).Take<std::uint64_t>() != Checksum(directory))
  {
    throw Error(where, "the checksum of its directory is wrong");
  }
  return directory;
}

std::vector<std::string> CacheFile::Names() const
{
  std::vector<std::string> names;
  std::transform(this->Entries.begin(), this->Entries.end(), std::back_inserter(names),
    [](const Entry& entry) { return entry.Name; });
  return names;
}

std::string CacheFile::Read(const std::string& name) const
{
  const auto entry = std::find_if(this->Entries.begin(), this->Entries.end(),
    [&name](const Entry& each) { return each.Name == name; });
  if (entry == this->Entries.end())
  {
    throw Error(this->Path.string(), "has no " + name);
  }
  std::string bytes = this->ReadBytes(entry->Offset, entry->Length);
  if (Checksum(bytes) != entry->Checksum)
  {
    throw Error(this->Path.string(), "the checksum of its " + name + " is wrong");
  }
  return bytes;
}

std::string CacheFile::Where(const std::string& name) const
{
  return this->Path.string() + ", " + name;
}

std::string CacheFile::ReadBytes(std::uint64_t offset, std::uint64_t count) const
{
  std::string bytes(count, '\0');
  for (std::size_t done = 0; done < count;)
  {
    const ssize_t got = ::pread(
      this->Descriptor, bytes.data() + done, count - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR)
    {
      continue;
    }
    if (got <= 0)
    {
      throw Error(this->Path.string(),
        got < 0 ? "cannot be read: " + SystemText() : std::string("became shorter"));
    }
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}
}
