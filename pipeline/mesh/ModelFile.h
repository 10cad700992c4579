// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Meshes in files for other programs; the extension states which:
 *
 *   .glb   glTF 2.0, one binary file with the texture inside (GltfFile.h)
 *   .obj   with NAME.mtl and the texture NAME.jpg beside it
 *   .ply   binary, with a colour and a normal per point
 *   .vtp   VTK's own, with the arrays Color and Normals
 *   .stl   binary, the shape alone
 *
 * Coordinates are the data set's in all of them; in .glb a node turns them to y up.
 */
#ifndef novelview_ModelFile_h
#define novelview_ModelFile_h

#include "mesh/Model.h"

#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/** ".glb, .obj, .ply, .vtp or .stl", for help and messages. */
std::string ModelFileKinds();

/** Throws UsageError, naming `option`, when a file is of no such kind or is named twice. */
void CheckModelFiles(const std::vector<std::filesystem::path>& files, const std::string& option);

/** The files that WriteModelFile() makes for this one; it is the last of them. */
std::vector<std::filesystem::path> FilesOfModel(const std::filesystem::path& file);

/** Writes the file (and what belongs beside it) atomically. Throws Error. */
void WriteModelFile(const TexturedModel& model, const std::filesystem::path& file);
}

#endif
