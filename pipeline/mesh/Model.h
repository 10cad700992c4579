// SPDX-License-Identifier: GPL-3.0-or-later
/** A mesh with the photographs' colours, to be taken elsewhere. */
#ifndef novelview_Model_h
#define novelview_Model_h

#include "synthesis/StageRunner.h"
#include "synthesis/SynthesisOptions.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>

namespace novelview
{
/** Coordinates are those of the data set. The three data sets are outputs of vtkTextureAtlasGenerator. */
struct TexturedModel
{
  vtkSmartPointer<vtkPolyData> Mesh;  ///< with Color and Normals per point
  vtkSmartPointer<vtkPolyData> Atlas; ///< the same mesh cut into charts, with TCoords and Normals
  vtkSmartPointer<vtkImageData> Texture; ///< Color
  int Charts = 0;
  double SeenShare = 0;                          ///< part of the charts that a photograph sees
  double UsedShare = 0;                          ///< part of the texture that charts cover
  Eigen::Vector3d Up = Eigen::Vector3d::UnitY(); ///< the direction that is up
};

/**
 * Colours a mesh from the views: with the blending of the options, but without a novel camera. The
 * texture's sides are at most `textureSizePx`. Runs as the stage "mesh texture". Throws Error, and
 * Interrupted when `progress` requests a stop.
 */
TexturedModel MakeTexturedModel(vtkPolyData* mesh, vtkMultiBlockDataSet* views,
  const SynthesisOptions& options, int textureSizePx, const StageProgress& progress = {},
  const StageDone& done = {});
}

#endif
