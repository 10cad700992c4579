// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/Model.h"

#include "Threads.h"
#include "ViewAccess.h"
#include "cameras/CameraUp.h"
#include "geometry/MeshNeighbours.h"

namespace novelview
{
namespace
{
Execution InParallel()
{
  Execution execution;
  execution.ParallelFor = ParallelFor;
  return execution;
}

std::vector<View> ColouredViews(vtkMultiBlockDataSet* views)
{
  ViewNeeds needs;
  needs.Color = needs.ContourDistance = true;
  return ReadViews(views, needs);
}
}

TexturedModel MakeTexturedModel(const TriangleMesh& mesh, vtkMultiBlockDataSet* views,
  const SynthesisOptions& options, int textureSizePx)
{
  const std::vector<View> photographs = ColouredViews(views);
  TextureAtlasOptions atlas;
  atlas.LargestSidePx = textureSizePx;
  atlas.Texture.References = options.References;
  atlas.Texture.Power = options.Power;
  atlas.Texture.FeatherPx = options.FeatherPx;
  atlas.Texture.OcclusionPx = options.OcclusionSoftness;
  atlas.Texture.UseGains = options.ExposureGains;
  TexturedModel model;
  model.Mesh = mesh;
  model.Normals = VertexNormals(mesh);
  model.PointColours = ColourPoints(mesh, photographs, atlas.Texture, InParallel());
  model.Atlas = MakeTextureAtlas(mesh, photographs, atlas, InParallel());
  std::vector<Camera> cameras;
  for (const View& view : photographs)
  {
    cameras.push_back(view.Cam);
  }
  model.Up = UpOfCameras(cameras);
  return model;
}
}
