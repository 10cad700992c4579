// SPDX-License-Identifier: GPL-3.0-or-later
/** The masks that lie in people's folders. */
#ifndef novelview_MaskFiles_h
#define novelview_MaskFiles_h

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace novelview
{
/**
 * The masks of a data set's folder, listed once. Of a photograph sub/a.jpg they are, in this order,
 * with any picture's extension (.png first) and in any case of letters:
 *
 *  - in a folder of masks (mask, masks, silhouettes, silhouette, segmentation, segmentations,
 *    segmented): sub/a.jpg, sub/a, sub/a.jpg, sub/a_mask, sub/a.mask, sub/a.jpg.mask, sub/a.jpg_mask,
 *    each followed by an extension but the first; also below images/ of that folder
 *  - beside the photograph: the same but for the first two
 */
class MaskFiles
{
public:
  explicit MaskFiles(const std::filesystem::path& folder);

  /** The mask file of a photograph; empty when there is none. */
  std::filesystem::path Of(const std::string& photograph);

  /** Pictures in folders of masks that are no photograph's mask so far. */
  std::vector<std::filesystem::path> Unused() const;

  /** Folders that are named like masks, hold pictures and are not read. */
  std::vector<std::filesystem::path> UnreadFolders() const;

private:
  /** A picture in a folder of masks. */
  struct Entry
  {
    std::filesystem::path File;
    std::string Name; ///< in its folder, without images/ in front, in lower case
  };

  /** The pictures in a folder of photographs. */
  const std::vector<Entry>& PicturesIn(const std::filesystem::path& place);

  std::filesystem::path Folder;
  std::vector<std::vector<Entry>> Masks; ///< by folder, in the order of the names above
  std::map<std::filesystem::path, std::vector<Entry>> Beside; ///< by folder, as far as asked for
  std::set<std::filesystem::path> Used;
};
}

#endif
