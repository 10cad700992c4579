// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * What the benchmarks work on: photographs of the generator's bunny, and what the stages make of
 * them. Everything is computed at the first need and kept as long as the process.
 */
#ifndef novelview_bench_BenchScene_h
#define novelview_bench_BenchScene_h

#include "geometry/TriangleMesh.h"
#include "synthesis/SynthesisStages.h"

#include <compare>
#include <string>
#include <vector>

namespace novelview::bench
{
/** Photographs all around the object, of 4:3. */
struct PhotoSet
{
  int Views = 12;
  int Width = 640; ///< pixels

  int Height() const { return this->Width * 3 / 4; }
  auto operator<=>(const PhotoSet&) const = default;
};

/** The photographs as the data model has them, taken by the generator's cameras, without files. */
vtkMultiBlockDataSet* Photographs(const PhotoSet& set);

/** The camera midway between the first two photographs', with a picture of their size. */
Camera NovelCamera(const PhotoSet& set);

/**
 * The stages on such photographs, with the options of a preset and the novel camera; the mapper
 * textures the finished mesh, as a run does.
 */
SynthesisStages& Stages(const PhotoSet& set, const std::string& preset);

/** About this many samples of the visual hull of twelve photographs of 640x480, with normals. */
const OrientedPoints& HullSamples(int count);

/** The power crust of those photographs at the default spacing. */
const TriangleMesh& Crust();
}

#endif
