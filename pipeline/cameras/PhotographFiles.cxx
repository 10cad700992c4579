// SPDX-License-Identifier: GPL-3.0-or-later
#include "cameras/PhotographFiles.h"

#include "base/NumberText.h"
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

bool IsPicture(const fs::path& path)
{
  constexpr std::array Extensions{ ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".ppm", ".pgm",
    ".webp" };
  return std::find(Extensions.begin(), Extensions.end(), LowerCase(path.extension().string())) !=
    Extensions.end();
}

/** Whether a file is named like a mask beside its photograph. */
bool IsNamedMask(const fs::path& path)
{
  const std::string stem = LowerCase(path.stem().string());
  return stem.ends_with("_mask") || stem.ends_with(".mask") ||
    (IsPicture(path.stem()) && IsFile(path.parent_path() / path.stem()));
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

fs::path MaskFileOf(const fs::path& folder, const std::string& name)
{
  const fs::path photograph(name);
  const fs::path stem = photograph.parent_path() / photograph.stem();
  const std::array beside{ fs::path(name + ".png"), fs::path(stem.string() + "_mask.png"),
    fs::path(stem.string() + ".mask.png") };
  for (const char* masks : { "mask", "masks", "silhouettes" })
  {
    for (const fs::path& file : { photograph, fs::path(stem.string() + ".png") })
    {
      if (IsFile(folder / masks / file))
      {
        return folder / masks / file;
      }
    }
    for (const fs::path& file : beside)
    {
      if (IsFile(folder / masks / file))
      {
        return folder / masks / file;
      }
    }
  }
  for (const fs::path& file : beside)
  {
    if (IsFile(folder / file))
    {
      return folder / file;
    }
  }
  return {};
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
    if (IsPicture(file) && !IsNamedMask(file))
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
