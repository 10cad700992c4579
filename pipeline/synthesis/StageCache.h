// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_StageCache_h
#define novelview_StageCache_h

#include "synthesis/SceneGeometry.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <optional>
#include <string>

namespace novelview
{
struct SynthesisOptions;

/**
 * Keeps SceneGeometry results in a folder, one file DIR/KEY.nvcache each (CacheFile). KEY is a hash
 * (XXH3, 128 bits) of everything the results follow from: pixels, silhouettes, cameras, the options of
 * these stages, and the libraries' machine code. Every byte of an entry is under a checksum, and one
 * that does not match is as good as none. Entries may be deleted at any time.
 */
class StageCache
{
public:
  StageCache(
    std::filesystem::path folder, vtkMultiBlockDataSet* views, const SynthesisOptions& options);

  /** The kept results; nothing when there are none, or none that can be used (see Damage()). */
  std::optional<SceneGeometry> Load();

  /** Why the entry that Load() found cannot be used; empty when it can, or when there is none. */
  const std::string& Damage() const { return this->Wrong; }

  /** Keeps results, in place of what is there. Throws Error when the file cannot be written. */
  void Store(const SceneGeometry& results) const;

  std::filesystem::path Entry() const { return this->Folder / (this->Key + ".nvcache"); }

private:
  std::filesystem::path Folder;
  std::string Key;
  std::string Wrong;
  vtkSmartPointer<vtkMultiBlockDataSet> Views; ///< as they came
};
}

#endif
