// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_RunOptions_h
#define novelview_RunOptions_h

#include "commands/MethodOptions.h"
#include "dataset/ViewSpec.h"
#include "texture/TextureAtlasOptions.h"

#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/** One novel view with everything that is reported about it: `novelview run`. */
struct RunOptions : MethodOptions
{
  ViewSpec View;
  std::filesystem::path Out;
  std::filesystem::path Truth;     ///< image to compare with; empty = what the view implies
  std::filesystem::path TruthMask; ///< its silhouette; empty = what lies in mask/ beside it
  std::filesystem::path TrueMesh;  ///< for the oracle; empty = none
  bool WriteIterations = true;     ///< novel view, mesh and scores of every iteration
  bool Screenshots = true;         ///< and an image of the scene
  bool Page = true;                ///< report.html and the image of the rig
  std::vector<std::filesystem::path> MeshOut; ///< files of the view's mesh, see ModelFile.h
  /** Of the mesh's texture, at most. */
  int TextureSizePx = TextureAtlasOptions::LargestSidePxParameter.Default;
};

/** The table: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(RunOptions& options);

/**
 * See MergeOptions(). Throws UsageError, also when there is no view or options contradict each other, and
 * Error when the job.json of the results could not hold a name, which must be UTF-8.
 */
RunOptions MakeRunOptions(const std::filesystem::path& dataset, const ParsedArguments& given,
  const OptionWarning& warn = {});

/**
 * A job file in the out folder: every option that can change the result, so that running the file does
 * the same again. out is ".", the folder of the file; other paths are absolute.
 */
std::string JobText(const RunOptions& options);
}

#endif
