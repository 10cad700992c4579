// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/MeshOptions.h"

#include "mesh/ModelFile.h"

namespace novelview
{
namespace fs = std::filesystem;

OptionTable OptionsOf(MeshOptions& options)
{
  const char* const mesh = "Mesh";
  OptionTable table = {
    { "out", "files for the mesh: " + ModelFileKinds(), "", mesh, &options.Out },
    ParameterOption("simplify", "triangles to leave; 0 = all", mesh,
      &options.Simplification.Triangles, MeshSimplificationOptions::TrianglesParameter),
    TextureSizeOption(options.TextureSizePx, mesh),
  };
  return WithMethod(std::move(table), options);
}

MeshOptions MakeMeshOptions(
  const fs::path& dataset, const ParsedArguments& given, const OptionWarning& warn)
{
  MeshOptions options = MergedOptions<MeshOptions>(dataset, given, warn);
  CheckModelFiles(options.Out, "--out");
  return options;
}
}
