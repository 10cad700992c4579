// SPDX-License-Identifier: GPL-3.0-or-later
/** Where photographs and masks lie in people's folders, and what their files are called. */
#ifndef novelview_PhotographFiles_h
#define novelview_PhotographFiles_h

#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/** The mask file of the photograph folder/name, see MaskFiles; empty when there is none. */
std::filesystem::path MaskFileOf(const std::filesystem::path& folder, const std::string& name);

/** Whether a file has the extension of a picture, in any case of letters. */
bool IsPictureName(const std::filesystem::path& file);

/**
 * The files that lie in a folder itself, sorted; none when there is no such folder. Throws Error when
 * it cannot be read.
 */
std::vector<std::filesystem::path> FilesIn(const std::filesystem::path& folder);

/**
 * The photographs that lie in a folder itself, by name, in natural order (a2 before a10). Masks
 * that lie beside them are left out.
 */
std::vector<std::string> PhotographsIn(const std::filesystem::path& folder);

/** Numbers within names count as numbers: a2 before a10. */
bool NaturallyBefore(const std::string& a, const std::string& b);

/**
 * The file of this path; where there is none, the only one whose path differs from it by the case of
 * letters alone; else the path itself.
 */
std::filesystem::path FileOfAnyCase(const std::filesystem::path& path);

/**
 * The photograph or mask that a calibration means by a path that is no file: written with backslashes,
 * in another case, or absolute on another computer, of which the longest ending is taken that is a
 * file in the folder or its images/. Empty when there is none.
 */
std::filesystem::path FileMeant(const std::filesystem::path& folder, const std::string& path);

/** The first of these folders that has a file of this name; without any, the first folder's. */
std::filesystem::path FileIn(
  const std::vector<std::filesystem::path>& folders, const std::string& name);

/**
 * The name of a photograph in its data set: its path, made relative to the folder and without
 * anything that leads out of it; a leading images/ is left out.
 */
std::string NameOfFile(const std::filesystem::path& file);

/**
 * The name of a view's image in the folder that it is written into: NameOfFile(), with .png after
 * it where there is no extension of a format that can be written. Throws Error when nothing is
 * left.
 */
std::string PictureNameOf(const std::string& view);
}

#endif
