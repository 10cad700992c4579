// SPDX-License-Identifier: GPL-3.0-or-later
#include "Threads.h"
#include "geometry/MeshNeighbours.h"
#include "support/Stop.h"
#include "support/VtkScene.h"
#include "texture/TextureAtlas.h"
#include "vtkTextureAtlasGenerator.h"

#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkPointData.h>

using namespace novelview;
using namespace support;

namespace
{
/** A textured ball, eight photographs around it. */
struct BallCase
{
  std::vector<Photo> Photos = TakeAll(Sphere(Vector3d::Zero(), 0.5), Waves(0.6), Ring(8, 45));
  vtkSmartPointer<vtkMultiBlockDataSet> Blocks = ToBlocks(Photos);
  TriangleMesh Mesh = SphereMesh(Vector3d::Zero(), 0.5, 3);

  vtkSmartPointer<vtkTextureAtlasGenerator> Generator() const
  {
    auto generator = vtkSmartPointer<vtkTextureAtlasGenerator>::New();
    generator->SetInputData(0, ToPolyData(this->Mesh));
    generator->SetInputData(1, this->Blocks);
    return generator;
  }
};

const BallCase& TheCase()
{
  static const BallCase ball;
  return ball;
}

std::vector<std::uint8_t> Pixels(vtkTextureAtlasGenerator* generator)
{
  const auto rows =
    TopDownArray<const std::uint8_t>(generator->GetTexture(), arrays::Color, 3, "texture", true);
  std::vector<std::uint8_t> values;
  for (int y = 0; y < rows.Height; ++y)
  {
    values.insert(values.end(), rows.Row(y), rows.Row(y) + 3 * rows.Width);
  }
  return values;
}

std::vector<double> Values(vtkDataArray* array)
{
  std::vector<double> values;
  for (vtkIdType tuple = 0; tuple < array->GetNumberOfTuples(); ++tuple)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      values.push_back(array->GetComponent(tuple, c));
    }
  }
  return values;
}
}

TEST(TextureAtlasGenerator, GivesTheKernelsColoursChartsAndTexture)
{
  const BallCase& ball = TheCase();
  const auto generator = ball.Generator();
  generator->SetTextureSize(256);
  generator->SetReferences(2);
  generator->SetPower(3);
  generator->SetFeatherWidth(4);
  generator->SetOcclusionSoftness(2);
  generator->UseExposureGainsOff();
  generator->Update();

  TextureAtlasOptions options;
  options.LargestSidePx = 256;
  options.Texture.References = 2;
  options.Texture.Power = 3;
  options.Texture.FeatherPx = 4;
  options.Texture.OcclusionPx = 2;
  options.Texture.UseGains = false;
  const auto views = ViewsOf(ball.Photos);
  const auto colours = ColourPoints(ball.Mesh, views, options.Texture);
  const TextureAtlas atlas = MakeTextureAtlas(ball.Mesh, views, options);

  vtkPolyData* mesh = generator->GetOutput();
  EXPECT_EQ(Geometry(mesh).first, ball.Mesh.Points);
  EXPECT_EQ(Geometry(mesh).second, ball.Mesh.Triangles);
  std::vector<double> expectedColours;
  for (const auto& colour : colours)
  {
    expectedColours.insert(expectedColours.end(), colour.begin(), colour.end());
  }
  EXPECT_EQ(Values(mesh->GetPointData()->GetScalars()), expectedColours);
  const auto normals = VertexNormals(ball.Mesh);
  EXPECT_EQ(Values(mesh->GetPointData()->GetNormals()), Values(NewNormals(normals)));

  vtkPolyData* charts = generator->GetAtlasMesh();
  EXPECT_EQ(Geometry(charts).first, atlas.Mesh.Points);
  EXPECT_EQ(Geometry(charts).second, atlas.Mesh.Triangles);
  auto* ids =
    vtkIdTypeArray::SafeDownCast(charts->GetPointData()->GetArray(arrays::OriginalPointIds));
  vtkDataArray* coordinates = charts->GetPointData()->GetTCoords();
  ASSERT_TRUE(ids && coordinates);
  for (std::size_t ptId = 0; ptId < atlas.PointOf.size(); ++ptId)
  {
    const auto tuple = static_cast<vtkIdType>(ptId);
    EXPECT_EQ(ids->GetValue(tuple), atlas.PointOf[ptId]);
    EXPECT_EQ(coordinates->GetComponent(tuple, 0), atlas.TexCoords[ptId].x());
    EXPECT_EQ(coordinates->GetComponent(tuple, 1), 1 - atlas.TexCoords[ptId].y());
    EXPECT_EQ(Vector3d(charts->GetPointData()->GetNormals()->GetTuple3(tuple)),
      normals[atlas.PointOf[ptId]].cast<float>().cast<double>());
  }
  EXPECT_EQ(generator->GetTexture()->GetDimensions()[0], atlas.Picture.Width);
  EXPECT_EQ(generator->GetTexture()->GetDimensions()[1], atlas.Picture.Height);
  EXPECT_EQ(Pixels(generator), atlas.Picture.Values);
  EXPECT_EQ(generator->GetNumberOfCharts(), atlas.Charts);
  EXPECT_EQ(generator->GetSeenShare(), atlas.SeenShare);
  EXPECT_EQ(generator->GetUsedShare(), atlas.UsedShare);
  EXPECT_LE(std::max(atlas.Picture.Width, atlas.Picture.Height), 256);
}

TEST(TextureAtlasGenerator, TextureCoordinatesPointAtTheTexelsAsVtkCountsThem)
{
  // The photograph's colour at a point is that of the texture at its coordinates.
  const BallCase& ball = TheCase();
  const auto generator = ball.Generator();
  generator->Update();
  vtkImageData* texture = generator->GetTexture();
  vtkPointData* points = generator->GetAtlasMesh()->GetPointData();
  vtkDataArray* meshColours = generator->GetOutput()->GetPointData()->GetScalars();
  double sum = 0;
  const vtkIdType count = generator->GetAtlasMesh()->GetNumberOfPoints();
  for (vtkIdType ptId = 0; ptId < count; ++ptId)
  {
    const double* at = points->GetTCoords()->GetTuple2(ptId);
    int ijk[3] = { static_cast<int>(at[0] * texture->GetDimensions()[0]),
      static_cast<int>(at[1] * texture->GetDimensions()[1]), 0 };
    const vtkIdType texel = texture->ComputePointId(ijk);
    const auto original =
      static_cast<vtkIdType>(points->GetArray(arrays::OriginalPointIds)->GetComponent(ptId, 0));
    for (int channel = 0; channel < 3; ++channel)
    {
      sum += std::abs(texture->GetPointData()->GetScalars()->GetComponent(texel, channel) -
        meshColours->GetComponent(original, channel));
    }
  }
  // The waves are some 40 texels long, 255 levels high: half a texel off is some levels.
  EXPECT_LT(sum / (3.0 * static_cast<double>(count)), 12);
}

TEST(TextureAtlasGenerator, RunsTwiceTheSameOnOneOrTwoThreadsAndOnlyWhenNeeded)
{
  const auto generator = TheCase().Generator();
  EventTexts ends(generator, vtkCommand::EndEvent);
  SetNumberOfThreads(1);
  generator->Update();
  const auto pixels = Pixels(generator);
  const auto mesh = Geometry(generator->GetAtlasMesh());
  generator->Update();
  generator->Update(2);
  EXPECT_EQ(ends.Texts.size(), 1u) << "it is up to date, by every port";
  SetNumberOfThreads(2);
  generator->Modified();
  generator->Update();
  EXPECT_EQ(ends.Texts.size(), 2u);
  EXPECT_EQ(Pixels(generator), pixels);
  EXPECT_EQ(Geometry(generator->GetAtlasMesh()), mesh);
  SetNumberOfThreads(0);
}

TEST(TextureAtlasGenerator, SaysWhatIsWrongAndRecovers)
{
  const auto generator = TheCase().Generator();
  generator->SetInputData(0, ToPolyData({}));
  ExpectUpdateError(generator, "texture atlas: the mesh has no triangles");
  EXPECT_EQ(generator->GetNumberOfCharts(), 0);
  generator->SetInputData(0, ToPolyData(TheCase().Mesh));
  const auto blocks = ToBlocks(TheCase().Photos);
  vtkImageData::SafeDownCast(blocks->GetBlock(2))->GetPointData()->RemoveArray("Color");
  generator->SetInputData(1, blocks);
  ExpectUpdateError(generator, "view 2 (p2): point array Color is missing");
  generator->SetInputData(1, vtkNew<vtkMultiBlockDataSet>());
  ExpectUpdateError(generator, "views: too few (got 0, expected at least 1)");
  generator->SetInputData(1, TheCase().Blocks);
  generator->Update();
  EXPECT_GT(generator->GetNumberOfCharts(), 0);
}

TEST(TextureAtlasGenerator, StopsWhenAborted)
{
  const auto generator = TheCase().Generator();
  EventTexts errors(generator, vtkCommand::ErrorEvent);
  EventTexts executiveErrors(generator->GetExecutive(), vtkCommand::ErrorEvent);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->AbortExecuteOn(); });
  const unsigned long tag = generator->AddObserver(vtkCommand::ProgressEvent, abort);
  generator->Update();
  EXPECT_EQ(generator->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(generator->GetTexture()->GetNumberOfPoints(), 0);
  generator->RemoveObserver(tag);
  generator->AbortExecuteOff();
  generator->Modified();
  generator->Update();
  EXPECT_GT(generator->GetTexture()->GetNumberOfPoints(), 0);
}

TEST(TextureAtlasGenerator, StopsWhenTheProgramIsAskedTo)
{
  const auto generator = TheCase().Generator();
  EventTexts errors(generator, vtkCommand::ErrorEvent);
  EventTexts executiveErrors(generator->GetExecutive(), vtkCommand::ErrorEvent);
  {
    Stop stop;
    stop.Flag = true;
    generator->Update();
  }
  EXPECT_EQ(errors.Texts.size(), 1u);
  EXPECT_EQ(generator->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(TextureAtlasGenerator, PrintsEveryMember)
{
  ExpectPrints(TheCase().Generator(),
    { "TextureSize", "References", "Power", "FeatherWidth", "OcclusionSoftness", "UseExposureGains",
      "NumberOfCharts", "SeenShare", "UsedShare" });
}
