// SPDX-License-Identifier: GPL-3.0-or-later
#include "AtomicFile.h"

#include "Error.h"
#include "Threads.h"

#include <fstream>
#include <system_error>
#include <unistd.h>

namespace novelview
{
namespace fs = std::filesystem;

void WriteAtomically(const fs::path& path, const std::function<bool(const fs::path&)>& write)
{
  ThrowIfStopRequested();
  std::error_code failure;
  if (!path.parent_path().empty())
  {
    fs::create_directories(path.parent_path(), failure);
    if (failure)
    {
      throw Error(path.parent_path().string(), "cannot make the folder: " + failure.message());
    }
  }
  // The extension stays last, since writers choose the format by it.
  fs::path temporary = path.parent_path() /
    ("." + path.stem().string() + "." + std::to_string(::getpid()) + path.extension().string());
  try
  {
    if (!write(temporary))
    {
      throw Error(path.string(), "cannot be written");
    }
    fs::rename(temporary, path, failure);
    if (failure)
    {
      throw Error(path.string(), "cannot be written: " + failure.message());
    }
  }
  catch (...)
  {
    fs::remove(temporary, failure);
    throw;
  }
}

void WriteTextAtomically(const fs::path& path, const std::string& text)
{
  WriteAtomically(path,
    [&text](const fs::path& temporary)
    {
      std::ofstream file(temporary, std::ios::binary);
      file << text;
      file.close();
      return file.good();
    });
}
}
