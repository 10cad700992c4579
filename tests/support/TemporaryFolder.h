// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef support_TemporaryFolder_h
#define support_TemporaryFolder_h

#include "core/Error.h"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace support
{
/** A folder of its own that goes away with its owner. */
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "novelview-XXXXXX").string();
    if (!::mkdtemp(name.data()))
    {
      throw novelview::Error(name, "cannot make a temporary folder");
    }
    this->Path = name;
  }
  ~TemporaryFolder()
  {
    std::error_code failure;
    std::filesystem::remove_all(this->Path, failure);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return this->Path / name; }

  std::filesystem::path Path;
};
}

#endif
