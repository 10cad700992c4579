// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/Model.h"

#include "ViewAccess.h"
#include "cameras/CameraUp.h"
#include "vtkTextureAtlasGenerator.h"

#include <vtkNew.h>

#include <algorithm>

namespace novelview
{
TexturedModel MakeTexturedModel(vtkPolyData* mesh, vtkMultiBlockDataSet* views,
  const SynthesisOptions& options, int textureSizePx, const StageProgress& progress,
  const StageDone& done)
{
  const vtkNew<vtkTextureAtlasGenerator> generator;
  generator->SetInputData(0, mesh);
  generator->SetInputData(1, views);
  generator->SetTextureSize(textureSizePx);
  generator->SetReferences(options.Texture.References);
  generator->SetPower(std::min(options.Texture.Power, TextureAtlasOptions::MaxPower));
  generator->SetFeatherWidth(options.Texture.FeatherPx);
  generator->SetOcclusionSoftness(options.Texture.OcclusionPx);
  generator->SetUseExposureGains(options.Texture.UseGains);
  RunStage("mesh texture", generator, progress, done);

  TexturedModel model;
  model.Mesh = generator->GetOutput();
  model.Atlas = generator->GetAtlasMesh();
  model.Texture = generator->GetTexture();
  model.Charts = generator->GetNumberOfCharts();
  model.SeenShare = generator->GetSeenShare();
  model.UsedShare = generator->GetUsedShare();
  std::vector<Camera> cameras;
  for (unsigned int viewId = 0; viewId < views->GetNumberOfBlocks(); ++viewId)
  {
    cameras.push_back(AttachedCamera(ViewImage(views, viewId), ViewName(views, viewId)));
  }
  model.Up = UpOfCameras(cameras);
  return model;
}
}
