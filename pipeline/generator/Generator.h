// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Generator_h
#define novelview_Generator_h

#include "generator/GeneratorOptions.h"

#include <filesystem>
#include <functional>
#include <string>

namespace novelview
{
/** Receives the current step and its progress, 0 to 1; returns false to request a stop. */
using GeneratorProgress = std::function<bool(const std::string& what, double fraction)>;

/**
 * Photographs an object and writes a data set of the Middlebury layout into a folder:
 *
 *     NAME0000.png ...    photographs, NAME = the object's
 *     NAME_par.txt        count, then `file K(9) R(9) t(3)` per line, row-major
 *     mask/FILE           coverage, 0 to 255; where it crosses 127.5 is the contour
 *     test/               test0000.png ..., test_par.txt and mask/ of the held-out views
 *     truth.ply           the mesh
 *     overview.png        object, cameras and held-out cameras as a desktop program would show them
 *     generate.json       all options
 *
 * The same options give the same files, bit for bit. Throws Error on bad options or files, and
 * Interrupted when the listener requests a stop.
 */
void GenerateDataset(const GeneratorOptions& options, const std::filesystem::path& out,
  const GeneratorProgress& progress = {});
}

#endif
