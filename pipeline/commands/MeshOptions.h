// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MeshOptions_h
#define novelview_MeshOptions_h

#include "commands/MethodOptions.h"
#include "geometry/MeshSimplificationOptions.h"
#include "texture/TextureAtlasOptions.h"

#include <filesystem>
#include <vector>

namespace novelview
{
/** The whole object as a mesh with the photographs' colours: `novelview mesh`. */
struct MeshOptions : MethodOptions
{
  std::vector<std::filesystem::path> Out; ///< files, see ModelFile.h
  MeshSimplificationOptions Simplification;
  /** Of the texture, at most. */
  int TextureSizePx = TextureAtlasOptions::LargestSidePxParameter.Default;
};

/** The table: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(MeshOptions& options);

/** See MergeOptions(). Throws UsageError. */
MeshOptions MakeMeshOptions(const std::filesystem::path& dataset, const ParsedArguments& given,
  const OptionWarning& warn = {});
}

#endif
