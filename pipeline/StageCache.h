// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_StageCache_h
#define novelview_StageCache_h

#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace novelview
{
struct SynthesisOptions;

/** What the stages make of the photographs for every novel camera alike. */
struct ViewIndependent
{
  vtkSmartPointer<vtkPolyData> Hull;
  vtkSmartPointer<vtkPolyData> Crust;
  vtkSmartPointer<vtkPolyData> MedialBalls;
  vtkSmartPointer<vtkMultiBlockDataSet>
    Views;                           ///< the photographs as deformers and mapper want them
  std::vector<std::string> Warnings; ///< what was said on the way
};

/**
 * Keeps ViewIndependent results in a folder, DIR/KEY/ with VTK's XML files and a manifest of their
 * checksums. KEY is a hash (XXH3, 128 bits) of everything the results follow from: pixels,
 * silhouettes, cameras, the options of these stages, and the libraries' machine code. An entry that
 * does not match its checksums is as good as none. Entries may be deleted at any time.
 */
class StageCache
{
public:
  StageCache(
    std::filesystem::path folder, vtkMultiBlockDataSet* views, const SynthesisOptions& options);

  /** The kept results; nothing when there are none, or when they are damaged (see Damage()). */
  std::optional<ViewIndependent> Load();

  /** What was wrong with the entry that Load() found; empty when nothing was. */
  const std::string& Damage() const { return this->Wrong; }

  /** Keeps results: all or nothing. Throws Error when the folder cannot be written. */
  void Store(const ViewIndependent& results) const;

  std::filesystem::path Entry() const { return this->Folder / this->Key; }

private:
  std::filesystem::path Folder;
  std::string Key;
  std::string Wrong;
  vtkMultiBlockDataSet* Views;
};
}

#endif
