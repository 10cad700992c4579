// SPDX-License-Identifier: GPL-3.0-or-later
#include "cameras/MaskFiles.h"

#include "base/NumberText.h"
#include "cameras/PhotographFiles.h"

#include <algorithm>
#include <array>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
constexpr std::array MaskFolders{ "mask", "masks", "silhouettes", "silhouette", "segmentation",
  "segmentations", "segmented" };

/** Folders of a folder, sorted. */
std::vector<fs::path> FoldersIn(const fs::path& folder)
{
  std::vector<fs::path> folders;
  std::error_code failure;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, failure), end;
       !failure && entry != end; entry.increment(failure))
  {
    std::error_code none;
    if (fs::is_directory(entry->path(), none))
    {
      folders.push_back(folder / entry->path().filename());
    }
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

/** The pictures of a folder and of those in it, a few levels deep. */
std::vector<fs::path> PicturesBelow(const fs::path& folder, int levels = 4)
{
  std::vector<fs::path> files;
  for (const fs::path& file : FilesIn(folder))
  {
    if (IsPictureName(file))
    {
      files.push_back(file);
    }
  }
  if (levels > 0)
  {
    for (const fs::path& each : FoldersIn(folder))
    {
      const std::vector<fs::path> deeper = PicturesBelow(each, levels - 1);
      files.insert(files.end(), deeper.begin(), deeper.end());
    }
  }
  return files;
}

/** What a mask of a photograph is called, but for its extension; without the first, beside it. */
std::vector<std::string> MaskStems(const std::string& photograph)
{
  const std::string name = LowerCase(photograph);
  const fs::path path(name);
  const std::string stem = (path.parent_path() / path.stem()).string();
  return { stem, name, stem + "_mask", stem + ".mask", name + ".mask", name + "_mask" };
}

/** Whether `name` is `stem` and an extension. */
bool IsStemOf(const std::string& stem, const std::string& name)
{
  return name.size() > stem.size() && name.starts_with(stem) && name[stem.size()] == '.' &&
    fs::path(name).extension().string().size() == name.size() - stem.size();
}

/** The name that a mask goes by: .png first among those that differ by extension alone. */
bool Before(const std::string& a, const std::string& b)
{
  const bool png[] = { a.ends_with(".png"), b.ends_with(".png") };
  return png[0] != png[1] ? png[0] : a < b;
}
}

MaskFiles::MaskFiles(const fs::path& folder)
  : Folder(folder)
  , Masks(MaskFolders.size())
{
  for (const fs::path& each : FoldersIn(folder))
  {
    const std::string name = LowerCase(each.filename().string());
    const auto known = std::find(MaskFolders.begin(), MaskFolders.end(), name);
    if (known == MaskFolders.end())
    {
      continue;
    }
    for (const fs::path& file : PicturesBelow(each))
    {
      std::string within = LowerCase(file.lexically_relative(each).generic_string());
      within = within.starts_with("images/") ? within.substr(7) : within;
      this->Masks[static_cast<std::size_t>(known - MaskFolders.begin())].push_back(
        { file, within });
    }
  }
}

const std::vector<MaskFiles::Entry>& MaskFiles::PicturesIn(const fs::path& place)
{
  const auto [found, isNew] = this->Beside.try_emplace(place);
  if (isNew)
  {
    for (const fs::path& file : FilesIn(this->Folder / place))
    {
      if (IsPictureName(file))
      {
        found->second.push_back({ file, LowerCase((place / file.filename()).generic_string()) });
      }
    }
  }
  return found->second;
}

fs::path MaskFiles::Of(const std::string& photograph)
{
  const std::string name = LowerCase(fs::path(photograph).generic_string());
  const std::vector<std::string> stems = MaskStems(photograph);
  const auto choose = [this](const std::vector<Entry>& entries, const auto& fits) -> fs::path
  {
    const Entry* best = nullptr;
    for (const Entry& entry : entries)
    {
      best = fits(entry.Name) && (!best || Before(entry.Name, best->Name)) ? &entry : best;
    }
    return best ? *this->Used.insert(best->File).first : fs::path();
  };
  for (const std::vector<Entry>& entries : this->Masks)
  {
    fs::path found = choose(entries, [&](const std::string& each) { return each == name; });
    for (std::size_t i = 0; i < stems.size() && found.empty(); ++i)
    {
      found = choose(entries, [&](const std::string& each) { return IsStemOf(stems[i], each); });
    }
    if (!found.empty())
    {
      return found;
    }
  }
  const std::vector<Entry>& beside = this->PicturesIn(fs::path(photograph).parent_path());
  for (std::size_t i = 1; i < stems.size(); ++i)
  {
    const fs::path found =
      choose(beside, [&](const std::string& each) { return IsStemOf(stems[i], each); });
    if (!found.empty())
    {
      return found;
    }
  }
  return {};
}

std::vector<fs::path> MaskFiles::Unused() const
{
  std::vector<fs::path> unused;
  for (const std::vector<Entry>& entries : this->Masks)
  {
    for (const Entry& entry : entries)
    {
      // novelview mask writes it.
      if (!this->Used.contains(entry.File) && entry.Name != "contact-sheet.png")
      {
        unused.push_back(entry.File);
      }
    }
  }
  return unused;
}

std::vector<fs::path> MaskFiles::UnreadFolders() const
{
  constexpr std::array words{ "mask", "silhouette", "segment", "matte", "alpha", "foreground" };
  std::vector<fs::path> unread;
  for (const fs::path& each : FoldersIn(this->Folder))
  {
    const std::string name = LowerCase(each.filename().string());
    const bool read = std::find(MaskFolders.begin(), MaskFolders.end(), name) != MaskFolders.end();
    const bool named = std::any_of(words.begin(), words.end(),
      [&name](const char* word) { return name.find(word) != std::string::npos; });
    if (named && !read && !PicturesBelow(each).empty())
    {
      unread.push_back(each);
    }
  }
  return unread;
}
}
