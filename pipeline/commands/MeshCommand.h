// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MeshCommand_h
#define novelview_MeshCommand_h

#include "base/Console.h"
#include "commands/MeshOptions.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>

namespace novelview
{
/** `novelview mesh`: the whole object as files for other programs. Throws Error. */
void MakeMesh(const MeshOptions& options, Console& console);

/** Announces the files of a mesh and proves that their folders can be written. Throws Error. */
void PrepareModelFiles(const std::vector<std::filesystem::path>& files);

/**
 * Colours a mesh from the views, writes it into every file, and prints the names. Throws Error and
 * Interrupted.
 */
void WriteModelFiles(vtkPolyData* mesh, vtkMultiBlockDataSet* views,
  const SynthesisOptions& synthesis, int textureSizePx,
  const std::vector<std::filesystem::path>& files, Console& console);
}

#endif
