// SPDX-License-Identifier: GPL-3.0-or-later
/** Where photographs and masks lie in people's folders, and what their files are called. */
#ifndef novelview_PhotographFiles_h
#define novelview_PhotographFiles_h

#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/**
 * The mask file of the photograph folder/name; empty when there is none. For a photograph sub/a.jpg
 * these are looked for, in this order:
 *
 *  - in mask/, masks/ and silhouettes/ of the folder: sub/a.jpg, sub/a.png, sub/a.jpg.png,
 *    sub/a_mask.png, sub/a.mask.png
 *  - beside the photograph: sub/a.jpg.png, sub/a_mask.png, sub/a.mask.png
 */
std::filesystem::path MaskFileOf(const std::filesystem::path& folder, const std::string& name);

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
