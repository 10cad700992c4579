// SPDX-License-Identifier: GPL-3.0-or-later
/** A mesh with the photographs' colours, to be taken elsewhere. */
#ifndef novelview_Model_h
#define novelview_Model_h

#include "synthesis/Synthesis.h"
#include "texture/TextureAtlas.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>

#include <array>
#include <cstdint>
#include <vector>

namespace novelview
{
/** Coordinates are those of the data set. */
struct TexturedModel
{
  TriangleMesh Mesh;
  std::vector<Eigen::Vector3d> Normals;                  ///< per point, outward
  std::vector<std::array<std::uint8_t, 3>> PointColours; ///< per point, RGB
  TextureAtlas Atlas;                                    ///< the same mesh cut into charts
  Eigen::Vector3d Up = Eigen::Vector3d::UnitY();         ///< the direction that is up
};

/**
 * Colours a mesh from the views: as the options blend the photographs, but for no novel camera. The
 * texture's sides are at most `textureSizePx`. Throws Error.
 */
TexturedModel MakeTexturedModel(const TriangleMesh& mesh, vtkMultiBlockDataSet* views,
  const SynthesisOptions& options, int textureSizePx);
}

#endif
