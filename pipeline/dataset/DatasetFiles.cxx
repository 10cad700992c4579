// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset/DatasetFiles.h"

#include "base/NumberText.h"
#include "cameras/MaskFiles.h"
#include "cameras/PhotographFiles.h"
#include "dataset/Dataset.h"

#include <algorithm>
#include <set>
#include <string>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/** Some names, and how many there are. */
std::string Some(const std::vector<fs::path>& files, const fs::path& folder)
{
  constexpr std::size_t most = 3;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(files.size(), most); ++i)
  {
    names.push_back(files[i].lexically_relative(folder).string());
  }
  return Joined(names) +
    (files.size() > most ? " .. (" + std::to_string(files.size()) + ")" : std::string());
}
}

const Photograph* PhotographOfName(
  const std::vector<Photograph>& photographs, const std::string& name)
{
  std::string slashed = name;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const std::string within = NameOfFile(slashed);
  const auto only = [&](const auto& fits) -> const Photograph*
  {
    const auto is = [&](const Photograph& each) { return fits(each); };
    const auto first = std::find_if(photographs.begin(), photographs.end(), is);
    const bool one = first != photographs.end() &&
      std::find_if(first + 1, photographs.end(), is) == photographs.end();
    return one ? &*first : nullptr;
  };
  const Photograph* found = only([&](const Photograph& each) { return each.Name == name; });
  found = found ? found : only([&](const Photograph& each) { return each.Name == within; });
  return found ? found
               : only([&](const Photograph& each)
                   { return fs::path(each.Name).replace_extension().string() == within; });
}

void FindFilesMeant(
  const fs::path& folder, std::vector<Photograph>& photographs, std::vector<ReadingNote>& notes)
{
  int count = 0;
  std::string example;
  for (Photograph& photograph : photographs)
  {
    for (fs::path* file : { &photograph.File, &photograph.Mask })
    {
      std::error_code failure;
      if (file->empty() || fs::exists(*file, failure))
      {
        continue;
      }
      const fs::path within = file->lexically_relative(folder);
      fs::path meant = FileMeant(folder, within.empty() ? file->string() : within.string());
      if (meant.empty() && file == &photograph.File)
      {
        meant = FileMeant(folder, photograph.Name);
      }
      if (meant.empty())
      {
        continue; // who reads it says that there is none
      }
      example = count++ == 0 ? file->string() + " is " + meant.string() : example;
      *file = meant;
    }
    if (photograph.Name.find('\\') != std::string::npos)
    {
      const fs::path within = photograph.File.lexically_relative(folder);
      photograph.Name = NameOfFile(within.empty() ? photograph.File.filename() : within);
    }
  }
  if (count > 0)
  {
    notes.push_back({ "file-name",
      std::to_string(count) + " files have other names than in the calibration: " + example,
      false });
  }
}

void FindMasks(
  const fs::path& folder, std::vector<Photograph>& photographs, std::vector<ReadingNote>& notes)
{
  std::set<fs::path> named;
  for (const Photograph& photograph : photographs)
  {
    named.insert(photograph.Mask);
  }
  std::vector<fs::path> unused;
  std::vector<fs::path> unread;
  for (const fs::path& base : { folder, folder / "images" })
  {
    MaskFiles masks(base);
    for (Photograph& photograph : photographs)
    {
      if (photograph.Mask.empty())
      {
        photograph.Mask = masks.Of(photograph.Name);
      }
    }
    for (const fs::path& file : masks.Unused())
    {
      if (!named.contains(file))
      {
        unused.push_back(file);
      }
    }
    const std::vector<fs::path> more = masks.UnreadFolders();
    unread.insert(unread.end(), more.begin(), more.end());
  }
  const bool all = std::none_of(photographs.begin(), photographs.end(),
    [](const Photograph& photograph) { return photograph.Mask.empty(); });
  if (!unused.empty())
  {
    notes.push_back({ "mask-unused",
      "not used, since they are no photograph's masks by their names: " + Some(unused, folder),
      !all });
  }
  if (!unread.empty() && !all)
  {
    notes.push_back({ "mask-unused",
      "not read: " + Some(unread, folder) +
        "; masks are looked for in mask/, masks/, silhouettes/ and segmentation/",
      true });
  }
}

void NotePhotographsWithoutCamera(const fs::path& folder,
  const std::vector<Photograph>& photographs, std::vector<ReadingNote>& notes)
{
  std::set<fs::path> known;
  std::set<fs::path> places;
  for (const Photograph& photograph : photographs)
  {
    known.insert(photograph.File.lexically_normal());
    known.insert(photograph.Mask.lexically_normal());
    const fs::path place = photograph.File.lexically_normal().parent_path();
    // In the folder itself lie other pictures, too.
    if (place != (folder / "x").lexically_normal().parent_path())
    {
      places.insert(place);
    }
  }
  std::vector<fs::path> without;
  for (const fs::path& place : places)
  {
    for (const std::string& name : PhotographsIn(place))
    {
      if (!known.contains((place / name).lexically_normal()))
      {
        without.push_back(place / name);
      }
    }
  }
  if (!without.empty())
  {
    notes.push_back({ "no-camera",
      "the calibration has no camera for " + std::to_string(without.size()) +
        " pictures beside its photographs: " + Some(without, folder.lexically_normal()),
      false });
  }
}
}
