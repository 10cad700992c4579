// SPDX-License-Identifier: GPL-3.0-or-later
#include "cameras/PhotographFiles.h"

#include "base/NumberText.h"
#include "cameras/MaskFiles.h"
#include "core/Error.h"

#include <algorithm>
#include <array>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
bool IsFile(const fs::path& path)
{
  std::error_code failure;
  return fs::is_regular_file(path, failure);
}

/** Whether a file is named like a mask beside its photograph. */
bool IsNamedMask(const fs::path& path)
{
  const std::string stem = LowerCase(path.stem().string());
  return stem.ends_with("_mask") || stem.ends_with(".mask") ||
    (IsPictureName(path.stem()) && IsFile(path.parent_path() / path.stem()));
}

bool IsDigit(char c)
{
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/** The run of digits at `at`, without leading zeros. */
std::string Digits(const std::string& text, std::size_t& at)
{
  std::size_t end = at;
  while (end < text.size() && IsDigit(text[end]))
  {
    ++end;
  }
  const std::size_t begin = std::min(text.find_first_not_of('0', at), end);
  std::string digits = text.substr(begin, end - begin);
  at = end;
  return digits;
}
}

bool IsPictureName(const fs::path& file)
{
  constexpr std::array Extensions{ ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".ppm", ".pgm",
    ".pbm", ".webp" };
  return std::find(Extensions.begin(), Extensions.end(), LowerCase(file.extension().string())) !=
    Extensions.end();
}

fs::path MaskFileOf(const fs::path& folder, const std::string& name)
{
  return MaskFiles(folder).Of(name);
}

std::vector<fs::path> FilesIn(const fs::path& folder)
{
  std::vector<fs::path> files;
  std::error_code failure;
  fs::directory_iterator entry(folder.empty() ? "." : folder, failure);
  for (; !failure && entry != fs::directory_iterator(); entry.increment(failure))
  {
    if (IsFile(entry->path()))
    {
      files.push_back(folder / entry->path().filename());
    }
  }
  if (failure && failure != std::errc::no_such_file_or_directory &&
    failure != std::errc::not_a_directory)
  {
    throw Error(folder.string(), "folder cannot be read: " + failure.message());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> PhotographsIn(const fs::path& folder)
{
  std::vector<std::string> names;
  for (const fs::path& file : FilesIn(folder))
  {
    if (IsPictureName(file) && !IsNamedMask(file))
    {
      names.push_back(file.filename().string());
    }
  }
  std::sort(names.begin(), names.end(), NaturallyBefore);
  return names;
}

bool NaturallyBefore(const std::string& a, const std::string& b)
{
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size())
  {
    if (IsDigit(a[i]) && IsDigit(b[j]))
    {
      const std::string left = Digits(a, i);
      const std::string right = Digits(b, j);
      if (left.size() != right.size())
      {
        return left.size() < right.size();
      }
      if (left != right)
      {
        return left < right;
      }
    }
    else if (a[i] != b[j])
    {
      return a[i] < b[j];
    }
    else
    {
      ++i;
      ++j;
    }
  }
  // Names that differ by leading zeros only still have an order.
  return a.size() - i != b.size() - j ? i == a.size() : a < b;
}

fs::path FileOfAnyCase(const fs::path& path)
{
  std::error_code failure;
  if (path.empty() || fs::exists(path, failure) || path == path.parent_path())
  {
    return path;
  }
  const fs::path folder = FileOfAnyCase(path.parent_path());
  const std::string wanted = LowerCase(path.filename().string());
  std::vector<fs::path> found;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, failure), end;
       !failure && entry != end; entry.increment(failure))
  {
    if (LowerCase(entry->path().filename().string()) == wanted)
    {
      found.push_back(folder / entry->path().filename());
    }
  }
  return found.size() == 1 ? found.front() : path;
}

fs::path FileMeant(const fs::path& folder, const std::string& path)
{
  std::string slashed = path;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const bool drive = slashed.size() > 1 && slashed[1] == ':';
  const fs::path whole = fs::path(drive ? slashed.substr(2) : slashed).lexically_normal();
  std::vector<fs::path> parts;
  for (const fs::path& part : whole.relative_path())
  {
    if (part != "..")
    {
      parts.push_back(part);
    }
  }
  const bool leadsOut = drive || whole.is_absolute() || whole.native().starts_with("..");
  for (std::size_t from = 0; from < parts.size() && (from == 0 || leadsOut); ++from)
  {
    fs::path ending;
    for (std::size_t i = from; i < parts.size(); ++i)
    {
      ending /= parts[i];
    }
    for (const fs::path& base : { folder, folder / "images" })
    {
      const fs::path file = FileOfAnyCase(base / ending);
      if (IsFile(file))
      {
        return file;
      }
    }
  }
  return {};
}

fs::path FileIn(const std::vector<fs::path>& folders, const std::string& name)
{
  for (const fs::path& folder : folders)
  {
    if (IsFile(folder / name))
    {
      return folder / name;
    }
  }
  return folders.front() / name;
}

std::string NameOfFile(const fs::path& file)
{
  fs::path name;
  for (const fs::path& part : file.lexically_normal().relative_path())
  {
    if (part != "." && part != ".." && !(name.empty() && part == "images"))
    {
      name /= part;
    }
  }
  return name.string();
}

std::string PictureNameOf(const std::string& view)
{
  constexpr std::array Written{ ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".ppm", ".webp" };
  const std::string name = NameOfFile(view);
  if (name.empty())
  {
    throw Error("view '" + view + "'", "has a name that no file can have");
  }
  const std::string extension = LowerCase(fs::path(name).extension().string());
  const bool known = std::find(Written.begin(), Written.end(), extension) != Written.end();
  return known ? name : name + ".png";
}
}
