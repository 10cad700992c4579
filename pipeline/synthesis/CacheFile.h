// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CacheFile_h
#define novelview_CacheFile_h

#include "synthesis/SceneGeometry.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/**
 * The bytes of a cache file: a directory, then the sections without gaps. The directory has
 *
 *     "NVCACHE\n", version, number of sections, its own length, the key,
 *     of each section the name, the length and the checksum (XXH3, 64 bits),
 *     the checksum of all of the directory before it
 *
 * so that every byte is under a checksum. They are taken of the bytes in memory. Numbers are in this
 * machine's byte order. Releases the sections' bytes on the way.
 */
std::string ComposeCacheFile(const std::string& key, std::vector<SceneSection> sections);

/** An open cache file; Read() may be called from several threads. */
class CacheFile
{
public:
  /** Reads and checks the directory. Throws Error unless it is the whole file of this key. */
  CacheFile(const std::filesystem::path& path, const std::string& key);
  ~CacheFile();
  CacheFile(const CacheFile&) = delete;
  void operator=(const CacheFile&) = delete;

  /** Whether the path exists, or cannot be read. */
  static bool Exists(const std::filesystem::path& path);

  /** The names of the sections. */
  std::vector<std::string> Names() const;

  /** The bytes of a section. Throws Error when there is none, or its checksum is wrong. */
  std::string Read(const std::string& name) const;

  /** A section's name for errors. */
  std::string Where(const std::string& name) const;

private:
  struct Entry
  {
    std::string Name;
    std::uint64_t Offset = 0;
    std::uint64_t Length = 0;
    std::uint64_t Checksum = 0;
  };

  void ReadDirectory(const std::string& key);
  std::string CheckedDirectory() const;
  std::string ReadBytes(std::uint64_t offset, std::uint64_t count) const;

  const std::filesystem::path Path;
  const int Descriptor;
  std::uint64_t Size = 0;
  std::vector<Entry> Entries;
};
}

#endif
