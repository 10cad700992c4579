// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkTextureAtlasGenerator.h"

#include "FilterSupport.h"
#include "geometry/MeshNeighbours.h"
#include "texture/TextureAtlas.h"

#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

vtkStandardNewMacro(vtkTextureAtlasGenerator);

namespace
{
void PackColouredMesh(const novelview::TriangleMesh& mesh,
  const std::vector<Eigen::Vector3d>& normals,
  const std::vector<std::array<std::uint8_t, 3>>& colours, vtkPolyData* output)
{
  novelview::FromTriangleMesh(mesh, output);
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName(novelview::arrays::Color);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(colours.size()));
  for (std::size_t ptId = 0; ptId < colours.size(); ++ptId)
  {
    array->SetTypedTuple(static_cast<vtkIdType>(ptId), colours[ptId].data());
  }
  output->GetPointData()->SetScalars(array);
  output->GetPointData()->SetNormals(novelview::NewNormals(normals));
}

void PackCharts(const novelview::TextureAtlas& atlas, const std::vector<Eigen::Vector3d>& normals,
  vtkPolyData* output)
{
  novelview::FromTriangleMesh(atlas.Mesh, output);
  const auto count = static_cast<vtkIdType>(atlas.PointOf.size());
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetName(novelview::arrays::TCoords);
  coordinates->SetNumberOfComponents(2);
  coordinates->SetNumberOfTuples(count);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName(novelview::arrays::OriginalPointIds);
  ids->SetNumberOfTuples(count);
  std::vector<Eigen::Vector3d> own;
  for (vtkIdType ptId = 0; ptId < count; ++ptId)
  {
    const Eigen::Vector2d& at = atlas.TexCoords[ptId];
    coordinates->SetTuple2(ptId, at.x(), 1 - at.y()); // the kernel counts from the top
    ids->SetValue(ptId, atlas.PointOf[ptId]);
    own.push_back(normals[atlas.PointOf[ptId]]);
  }
  output->GetPointData()->SetTCoords(coordinates);
  output->GetPointData()->SetNormals(novelview::NewNormals(own));
  output->GetPointData()->AddArray(ids);
}

/** A part of the work, from one fraction of the whole to another. */
novelview::Execution PartOf(const novelview::Execution& whole, double from, double to)
{
  novelview::Execution part;
  part.ParallelFor = whole.ParallelFor;
  part.StopRequested = whole.StopRequested;
  part.Progress = [progress = whole.Progress, from, to](double fraction)
  { return progress(from + (to - from) * fraction); };
  return part;
}
}

//------------------------------------------------------------------------------
vtkTextureAtlasGenerator::vtkTextureAtlasGenerator()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
}

//------------------------------------------------------------------------------
int vtkTextureAtlasGenerator::FillInputPortInformation(int port, vtkInformation* info)
{
  novelview::SetInputType(info, port, 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkTextureAtlasGenerator::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 2 ? "vtkImageData" : "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkTextureAtlasGenerator::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  // An image must state an extent; an empty one requests nothing, and the texture is computed
  // anyway.
  const int empty[6] = { 0, -1, 0, -1, 0, -1 };
  outputs->GetInformationObject(2)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), empty, 6);
  return 1;
}

//------------------------------------------------------------------------------
int vtkTextureAtlasGenerator::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->NumberOfCharts = 0;
  this->SeenShare = 0;
  this->UsedShare = 0;
  return novelview::RunGuarded(this, outputs,
    [&]
    {
      const novelview::TriangleMesh mesh =
        novelview::ToTriangleMesh(vtkPolyData::GetData(inputs[0]), "mesh");
      const std::vector<novelview::View> views =
        novelview::ReadColouredViews(vtkMultiBlockDataSet::GetData(inputs[1]));

      const novelview::Execution execution = novelview::ExecutionFor(this);
      const auto colours =
        novelview::ColourPoints(mesh, views, this->Options.Texture, PartOf(execution, 0, 0.3));
      const novelview::TextureAtlas atlas =
        novelview::MakeTextureAtlas(mesh, views, this->Options, PartOf(execution, 0.3, 1));

      const std::vector<Eigen::Vector3d> normals = novelview::VertexNormals(mesh);
      PackColouredMesh(mesh, normals, colours, vtkPolyData::GetData(outputs, 0));
      PackCharts(atlas, normals, vtkPolyData::GetData(outputs, 1));
      vtkImageData* texture = vtkImageData::GetData(outputs, 2);
      texture->SetDimensions(atlas.Picture.Width, atlas.Picture.Height, 1);
      novelview::CopyToArray(atlas.Picture, novelview::arrays::Color, texture);
      texture->GetPointData()->SetActiveScalars(novelview::arrays::Color);
      this->NumberOfCharts = atlas.Charts;
      this->SeenShare = atlas.SeenShare;
      this->UsedShare = atlas.UsedShare;
    });
}

//------------------------------------------------------------------------------
vtkPolyData* vtkTextureAtlasGenerator::GetAtlasMesh()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
vtkImageData* vtkTextureAtlasGenerator::GetTexture()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(2));
}

//------------------------------------------------------------------------------
void vtkTextureAtlasGenerator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->PrintOptions(os, indent);
  os << indent << "NumberOfCharts: " << this->NumberOfCharts << "\n";
  os << indent << "SeenShare: " << this->SeenShare << "\n";
  os << indent << "UsedShare: " << this->UsedShare << "\n";
}
