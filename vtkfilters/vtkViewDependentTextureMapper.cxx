// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkViewDependentTextureMapper.h"

#include "FilterSupport.h"
#include "ViewAccess.h"
#include "texture/TextureMapping.h"
#include "vtkPinholeCamera.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <optional>

vtkStandardNewMacro(vtkViewDependentTextureMapper);

//------------------------------------------------------------------------------
vtkViewDependentTextureMapper::vtkViewDependentTextureMapper()
{
  this->SetNumberOfInputPorts(3);
}

//------------------------------------------------------------------------------
vtkViewDependentTextureMapper::~vtkViewDependentTextureMapper() = default;

//------------------------------------------------------------------------------
void vtkViewDependentTextureMapper::SetCamera(vtkPinholeCamera* camera)
{
  novelview::SetCameraMember(this, this->Camera, camera);
}

//------------------------------------------------------------------------------
vtkPinholeCamera* vtkViewDependentTextureMapper::GetCamera()
{
  return this->Camera;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkViewDependentTextureMapper::GetMTime()
{
  return novelview::MTimeWithCamera(this->Superclass::GetMTime(), this->Camera);
}

//------------------------------------------------------------------------------
int vtkViewDependentTextureMapper::FillInputPortInformation(int port, vtkInformation* info)
{
  novelview::SetInputType(info, port, 1);
  if (port == 2)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkViewDependentTextureMapper::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  novelview::SetPictureInformation(outputs, this->Camera);
  return 1;
}

namespace
{
/** A soft occlusion test by depth maps is at least as soft as the maps are noisy. */
double SoftnessOf(const novelview::TextureOptions& options, vtkMultiBlockDataSet* views)
{
  constexpr double perNoise = 3;
  constexpr double most = 10;
  if (options.OcclusionPx <= 0 || !options.UseDepthMaps)
  {
    return options.OcclusionPx;
  }
  const double noise = novelview::DepthNoiseOf(views);
  return std::max(options.OcclusionPx, std::min(perNoise * noise, most));
}
}

//------------------------------------------------------------------------------
int vtkViewDependentTextureMapper::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      const novelview::Camera camera = novelview::RequireCamera(this->Camera);
      const novelview::TriangleMesh mesh =
        novelview::ToTriangleMesh(vtkPolyData::GetData(inputs[0]), "mesh");
      const std::vector<novelview::View> views =
        novelview::ReadColouredViews(vtkMultiBlockDataSet::GetData(inputs[1]));

      novelview::TextureOptions options = this->Options;
      options.BoundarySamples = this->Options.BoundarySamples | 1;
      options.OcclusionPx = SoftnessOf(options, vtkMultiBlockDataSet::GetData(inputs[1]));
      std::optional<novelview::TriangleMesh> occluders;
      vtkPolyData* others = vtkPolyData::GetData(inputs[2]);
      if (others && novelview::NeedsModel(views, options))
      {
        occluders = novelview::ToTriangleMesh(others, "occluders");
      }
      const novelview::TexturedView result = novelview::TextureView(mesh,
        occluders ? &*occluders : nullptr, views, camera, options, novelview::ExecutionFor(this));

      vtkImageData* output = vtkImageData::GetData(outputs);
      output->SetDimensions(camera.Width, camera.Height, 1);
      novelview::CopyToArray(result.Color, novelview::arrays::Color, output);
      novelview::CopyToArray(result.Mask, novelview::arrays::Mask, output);
      novelview::CopyToArray(result.Depth, novelview::arrays::Depth, output);
      novelview::CopyToArray(result.CellId, novelview::arrays::CellId, output);
      novelview::CopyToArray(result.Seen, novelview::arrays::Seen, output);
      output->GetPointData()->SetActiveScalars(novelview::arrays::Color);
    });
}

//------------------------------------------------------------------------------
void vtkViewDependentTextureMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintOptions(os, indent);
  novelview::PrintCamera(os, indent, this->Camera);
}
