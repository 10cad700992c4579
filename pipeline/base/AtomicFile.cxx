// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/AtomicFile.h"

#include "Threads.h"
#include "base/InputFile.h"
#include "base/TemporaryFile.h"
#include "core/Error.h"

#include <fstream>
#include <iterator>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
bool Holds(const fs::path& path, std::string_view bytes)
{
  std::error_code failure;
  if (!fs::is_regular_file(path, failure) || fs::file_size(path, failure) != bytes.size())
  {
    return false;
  }
  std::ifstream file(path, std::ios::binary);
  const std::string held((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  return held == bytes;
}
}

void AnnounceText(const fs::path& path, std::string_view bytes)
{
  if (!IsInput(path) || !Holds(path, bytes))
  {
    AnnounceOutput(path);
  }
}

void WriteTextAtomically(const fs::path& path, std::string_view bytes)
{
  ThrowIfStopRequested();
  WriteDespiteStop(path, bytes);
}

void WriteDespiteStop(const fs::path& path, std::string_view bytes)
{
  if (IsInput(path) && Holds(path, bytes))
  {
    return;
  }
  RequireReplaceable(path);
  TemporaryFile file(path);
  file.Write(bytes);
  file.Commit();
  NoteWritten(path);
}

void WriteAtomically(const fs::path& path, const std::function<bool(const fs::path&)>& write)
{
  ThrowIfStopRequested();
  RequireReplaceable(path);
  TemporaryFile file(path);
  if (!write(file.Path()))
  {
    throw Error(path.string(), "cannot be written");
  }
  file.Commit();
  NoteWritten(path);
}

void RequireWritable(const fs::path& folder)
{
  TemporaryFile(folder / "anything");
}
}
