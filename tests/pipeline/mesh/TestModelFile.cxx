// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes for other programs: what is written is read back, by VTK's own readers.
#include "ViewAccess.h"
#include "base/UsageError.h"
#include "drawing/OffscreenWindow.h"
#include "images/Metrics.h"
#include "mesh/GltfFile.h"
#include "mesh/ModelFile.h"
#include "support/TestSupport.h"
#include "support/VtkScene.h"

#include <nlohmann/json.hpp>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCompositeDataIterator.h>
#include <vtkFloatArray.h>
#include <vtkGLTFReader.h>
#include <vtkMatrix4x4.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSTLReader.h>
#include <vtkTexture.h>
#include <vtkXMLPolyDataReader.h>

#include <cstring>

using namespace novelview;
using namespace novelview::testing_support;
using Eigen::Vector3d;

namespace
{
/** A ball, textured by twelve photographs. */
class ModelFile : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    Photos = support::TakeAll(Scene(), Colours(), support::Ring(12, 30));
    Views = support::ToBlocks(Photos);
    Made = MakeTexturedModel(support::ToPolyData(support::SphereMesh(Vector3d::Zero(), 0.5, 5)),
      Views, PresetOptions("best"), 1024);
  }
  static void TearDownTestSuite()
  {
    Photos.clear();
    Views = nullptr;
    Made = {};
  }
  static support::Shape Scene() { return support::Sphere(Vector3d::Zero(), 0.5); }
  static support::Texture Colours() { return support::Waves(0.6); }

  /** The file, written; what belongs beside it is there, too. */
  std::filesystem::path Written(const std::string& name) const
  {
    WriteModelFile(Made, this->Folder / name);
    return this->Folder / name;
  }

  static inline std::vector<support::Photo> Photos;
  static inline vtkSmartPointer<vtkMultiBlockDataSet> Views;
  static inline TexturedModel Made;
  const TemporaryFolder Folder;
};

/** The two chunks of a GLB file. */
struct Chunks
{
  nlohmann::json Json;
  std::string Binary;
};

std::uint32_t WordAt(const std::string& bytes, std::size_t at)
{
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, 4);
  return word;
}

Chunks ChunksOf(const std::string& glb)
{
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(WordAt(glb, 4), 2u) << "version";
  EXPECT_EQ(WordAt(glb, 8), glb.size());
  const std::uint32_t length = WordAt(glb, 12);
  EXPECT_EQ(length % 4, 0u);
  EXPECT_EQ(glb.substr(16, 4), "JSON");
  const std::size_t second = 20 + length;
  const std::uint32_t binary = WordAt(glb, second);
  EXPECT_EQ(binary % 4, 0u);
  EXPECT_EQ(glb.substr(second + 4, 4), std::string("BIN\0", 4));
  EXPECT_EQ(second + 8 + binary, glb.size());
  return { nlohmann::json::parse(glb.substr(20, length)), glb.substr(second + 8) };
}

/** The one mesh that a GLB file contains, in the world of the file, and its texture. */
struct ReadBack
{
  vtkSmartPointer<vtkPolyData> Mesh;
  vtkSmartPointer<vtkImageData> Texture;
};

ReadBack ReadGlb(const std::filesystem::path& file)
{
  vtkNew<vtkGLTFReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  ReadBack result;
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutputDataObject(0));
  auto each = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
  for (each->InitTraversal(); !each->IsDoneWithTraversal(); each->GoToNextItem())
  {
    EXPECT_EQ(result.Mesh, nullptr) << "one mesh";
    result.Mesh = vtkPolyData::SafeDownCast(each->GetCurrentDataObject());
  }
  EXPECT_EQ(reader->GetNumberOfTextures(), 1);
  result.Texture = reader->GetGLTFTexture(0).Image;
  return result;
}

/** The mesh as a camera sees it, its texture unlit as the file requests. */
vtkSmartPointer<vtkImageData> Rendered(const ReadBack& model, const Camera& camera)
{
  // glTF counts texture coordinates from the top of the picture, VTK from the bottom.
  vtkDataArray* coordinates = model.Mesh->GetPointData()->GetTCoords();
  vtkNew<vtkFloatArray> flipped;
  flipped->SetNumberOfComponents(2);
  for (vtkIdType ptId = 0; ptId < coordinates->GetNumberOfTuples(); ++ptId)
  {
    flipped->InsertNextTuple2(
      coordinates->GetComponent(ptId, 0), 1 - coordinates->GetComponent(ptId, 1));
  }
  vtkNew<vtkPolyData> mesh;
  mesh->ShallowCopy(model.Mesh);
  mesh->GetPointData()->SetTCoords(flipped);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(model.Texture);
  texture->InterpolateOn();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetTexture(texture);
  actor->GetProperty()->LightingOff();
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  NewPinholeCamera(camera)->CopyToVTKCamera(renderer->GetActiveCamera(), 1, 10);
  const auto captured = RenderOffscreen(renderer, camera.Width, camera.Height);
  auto image = NewImage(camera.Width, camera.Height);
  const auto color = AddTopDownArray<std::uint8_t>(image, arrays::Color, 3);
  const auto mask = AddTopDownArray<std::uint8_t>(image, arrays::Mask, 1);
  const auto from = TopDownArray<const std::uint8_t>(captured, arrays::Color, 3, "rendered", true);
  for (int y = 0; y < camera.Height; ++y)
  {
    for (int x = 0; x < camera.Width; ++x)
    {
      std::copy(from.Pixel(x, y), from.Pixel(x, y) + 3, color.Pixel(x, y));
      mask(x, y) = from(x, y) || from(x, y, 1) || from(x, y, 2) ? 255 : 0;
    }
  }
  return image;
}
}

TEST_F(ModelFile, GlbFollowsTheSpecification)
{
  const Chunks glb = ChunksOf(GlbOf(Made));
  EXPECT_EQ(glb.Json.at("asset").at("version"), "2.0");
  ASSERT_EQ(glb.Json.at("buffers").size(), 1u);
  EXPECT_FALSE(glb.Json.at("buffers")[0].contains("uri")) << "the buffer is the binary chunk";
  const std::size_t length = glb.Json.at("buffers")[0].at("byteLength");
  EXPECT_LE(length, glb.Binary.size());
  EXPECT_LT(glb.Binary.size() - length, 4u) << "no more than the chunk's padding";
  std::size_t end = 0;
  for (const auto& view : glb.Json.at("bufferViews"))
  {
    const std::size_t offset = view.at("byteOffset");
    EXPECT_EQ(offset % 4, 0u) << "floats and indices are aligned";
    EXPECT_GE(offset, end) << "views do not overlap";
    end = offset + view.at("byteLength").get<std::size_t>();
    EXPECT_LE(end, length);
  }
  const auto& primitive = glb.Json.at("meshes")[0].at("primitives")[0];
  const std::map<int, int> bytesOf{ { 5126, 4 }, { 5125, 4 } };
  const std::map<std::string, int> partsOf{ { "SCALAR", 1 }, { "VEC2", 2 }, { "VEC3", 3 } };
  const auto check = [&](int accessorId, int target)
  {
    const auto& accessor = glb.Json.at("accessors")[accessorId];
    const auto& view = glb.Json.at("bufferViews")[accessor.at("bufferView").get<int>()];
    EXPECT_EQ(view.at("target"), target);
    EXPECT_EQ(view.at("byteLength").get<std::size_t>(),
      accessor.at("count").get<std::size_t>() * partsOf.at(accessor.at("type")) *
        bytesOf.at(accessor.at("componentType")));
    return accessor;
  };
  for (const auto& [name, accessorId] : primitive.at("attributes").items())
  {
    EXPECT_EQ(check(accessorId, 34962).at("count"), Made.Atlas->GetNumberOfPoints()) << name;
  }
  EXPECT_FALSE(primitive.at("attributes").contains("COLOR_0"))
    << "it would be multiplied with the texture";
  EXPECT_EQ(check(primitive.at("indices"), 34963).at("count"), 3 * Made.Atlas->GetNumberOfPolys());
  const auto& image = glb.Json.at("images")[0];
  const auto& pixels = glb.Json.at("bufferViews")[image.at("bufferView").get<int>()];
  EXPECT_FALSE(pixels.contains("target")) << "a picture is no vertex buffer";
  EXPECT_EQ(image.at("mimeType"), "image/jpeg");
  EXPECT_EQ(glb.Binary.substr(pixels.at("byteOffset").get<std::size_t>(), 2), "\xff\xd8");
}

TEST_F(ModelFile, GlbBoundsAreThoseOfTheStoredNumbers)
{
  const Chunks glb = ChunksOf(GlbOf(Made));
  const auto& attributes = glb.Json.at("meshes")[0].at("primitives")[0].at("attributes");
  const auto& accessor = glb.Json.at("accessors")[attributes.at("POSITION").get<int>()];
  const std::size_t offset =
    glb.Json.at("bufferViews")[accessor.at("bufferView").get<int>()].at("byteOffset");
  std::vector<float> values(3 * accessor.at("count").get<std::size_t>());
  std::memcpy(values.data(), glb.Binary.data() + offset, values.size() * sizeof(float));
  for (int axis = 0; axis < 3; ++axis)
  {
    float least = values[axis];
    float most = values[axis];
    for (std::size_t i = axis; i < values.size(); i += 3)
    {
      least = std::min(least, values[i]);
      most = std::max(most, values[i]);
    }
    EXPECT_EQ(accessor.at("min")[axis].get<float>(), least);
    EXPECT_EQ(accessor.at("max")[axis].get<float>(), most);
  }
}

TEST_F(ModelFile, GlbNodeTurnsUpToYAndKeepsTheDataSetsPlace)
{
  TexturedModel model = Made;
  const Vector3d far(1000, -2000, 500);
  model.Up = Vector3d(0, 0, 1);
  TriangleMesh moved = ToTriangleMesh(model.Atlas, "test");
  for (Vector3d& point : moved.Points)
  {
    point += far;
  }
  model.Atlas = vtkSmartPointer<vtkPolyData>::New();
  model.Atlas->ShallowCopy(Made.Atlas);
  FromTriangleMesh(moved, model.Atlas);
  const auto node = ChunksOf(GlbOf(model)).Json.at("nodes")[0];
  const auto r = node.at("rotation");
  const Eigen::Quaterniond turn(
    r[3].get<double>(), r[0].get<double>(), r[1].get<double>(), r[2].get<double>());
  EXPECT_LT((turn * model.Up - Vector3d::UnitY()).norm(), 1e-12);
  const auto t = node.at("translation");
  const Vector3d translation(t[0].get<double>(), t[1].get<double>(), t[2].get<double>());
  // The ball's box has its middle at `far`, to the rounding of its points.
  EXPECT_LT((turn.inverse() * translation - far).norm(), 1e-9);
}

TEST_F(ModelFile, GlbReadBackLooksLikeTheObjectFromACameraThatTookNoPhotograph)
{
  const ReadBack model = ReadGlb(this->Written("model.glb"));
  ASSERT_NE(model.Mesh, nullptr);
  EXPECT_EQ(model.Mesh->GetNumberOfCells(), Made.Mesh->GetNumberOfPolys());
  EXPECT_NE(model.Mesh->GetPointData()->GetTCoords(), nullptr);
  int size[3];
  model.Texture->GetDimensions(size);
  EXPECT_EQ(size[0], Made.Texture->GetDimensions()[0]);
  EXPECT_EQ(size[1], Made.Texture->GetDimensions()[1]);

  const Camera camera = support::OnRing(15);
  const support::Photo truth = support::Take(Scene(), Colours(), camera, "truth");
  const auto block = support::ToBlocks({ truth });
  const Scores scores = Compare(MaskedPictureOf(Rendered(model, camera), "rendered"),
    MaskedPictureOf(ViewImage(block, 0), "truth"));
  // Midway between two photographs of 100 pixels across, through JPEG and two interpolations: the
  // ring's own photographs differ from the truth at their rims by more.
  EXPECT_LT(scores.Rms, 8);
  EXPECT_GT(scores.Iou, 0.98);
  const support::Photo other = support::Take(Scene(), support::Waves(0.45), camera, "other");
  const auto otherBlock = support::ToBlocks({ other });
  EXPECT_GT(Compare(MaskedPictureOf(Rendered(model, camera), "rendered"),
              MaskedPictureOf(ViewImage(otherBlock, 0), "truth"))
              .Rms,
    3 * scores.Rms)
    << "another texture must be told apart";
}

TEST_F(ModelFile, PlyKeepsShapeAndColours)
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(this->Written("model.ply").c_str());
  reader->Update();
  vtkPolyData* poly = reader->GetOutput();
  const TriangleMesh mesh = ToTriangleMesh(poly, "ply");
  const TriangleMesh made = ToTriangleMesh(Made.Mesh, "made");
  vtkDataArray* madeColours = Made.Mesh->GetPointData()->GetArray(arrays::Color);
  EXPECT_EQ(mesh.Triangles, made.Triangles);
  vtkDataArray* colours = poly->GetPointData()->GetScalars();
  ASSERT_NE(colours, nullptr);
  ASSERT_EQ(colours->GetNumberOfComponents(), 3);
  for (std::size_t ptId = 0; ptId < mesh.Points.size(); ++ptId)
  {
    // Single precision of numbers up to one.
    EXPECT_LT((mesh.Points[ptId] - made.Points[ptId]).norm(), 1e-6);
    for (int channel = 0; channel < 3; ++channel)
    {
      EXPECT_EQ(colours->GetComponent(static_cast<vtkIdType>(ptId), channel),
        madeColours->GetComponent(static_cast<vtkIdType>(ptId), channel));
    }
  }
}

TEST_F(ModelFile, VtpKeepsEverything)
{
  const std::filesystem::path file = this->Written("model.vtp");
  EXPECT_EQ(ReadText(file).find("<AppendedData"), std::string::npos)
    << "which not every ParaView can read";
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  const TriangleMesh mesh = ToTriangleMesh(reader->GetOutput(), "vtp");
  const TriangleMesh made = ToTriangleMesh(Made.Mesh, "made");
  EXPECT_EQ(mesh.Triangles, made.Triangles);
  EXPECT_EQ(mesh.Points, made.Points) << "bit for bit";
  EXPECT_NE(reader->GetOutput()->GetPointData()->GetArray("Color"), nullptr);
  EXPECT_NE(reader->GetOutput()->GetPointData()->GetNormals(), nullptr);
}

TEST_F(ModelFile, StlKeepsTheShape)
{
  vtkNew<vtkSTLReader> reader;
  reader->SetFileName(this->Written("model.stl").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), Made.Mesh->GetNumberOfPolys());
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), Made.Mesh->GetNumberOfPoints())
    << "STL has every corner thrice; merged again the points are as many as before";
}

TEST_F(ModelFile, ObjNamesItsMaterialAndTheMaterialItsTexture)
{
  const std::filesystem::path file = this->Written("a model.obj");
  vtkNew<vtkOBJReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  const TriangleMesh mesh = ToTriangleMesh(reader->GetOutput(), "obj");
  const TriangleMesh made = ToTriangleMesh(Made.Atlas, "made");
  vtkDataArray* madeCoordinates = Made.Atlas->GetPointData()->GetTCoords();
  ASSERT_EQ(mesh.Triangles.size(), made.Triangles.size());
  ASSERT_EQ(mesh.Points.size(), made.Points.size());
  vtkDataArray* coordinates = reader->GetOutput()->GetPointData()->GetTCoords();
  ASSERT_NE(coordinates, nullptr);
  for (std::size_t ptId = 0; ptId < mesh.Points.size(); ++ptId)
  {
    // Six digits are written.
    EXPECT_LT((mesh.Points[ptId] - made.Points[ptId]).norm(), 1e-5);
    for (int axis = 0; axis < 2; ++axis)
    {
      EXPECT_NEAR(coordinates->GetComponent(static_cast<vtkIdType>(ptId), axis),
        madeCoordinates->GetComponent(static_cast<vtkIdType>(ptId), axis), 1e-5);
    }
  }
  EXPECT_THAT(ReadText(file), testing::StartsWith("mtllib a model.mtl\nusemtl photographs\n"));
  EXPECT_THAT(ReadText(this->Folder / "a model.mtl"), testing::HasSubstr("map_Kd a model.jpg\n"));
  EXPECT_TRUE(std::filesystem::exists(this->Folder / "a model.jpg"));
}

TEST_F(ModelFile, TexturingIsAStageThatTellsItsProgressAndCanBeStopped)
{
  const auto mesh = support::ToPolyData(support::SphereMesh(Vector3d::Zero(), 0.5, 3));
  double last = -1;
  std::string stage;
  MakeTexturedModel(
    mesh, Views, PresetOptions("best"), 256,
    [&last](const std::string&, double fraction)
    {
      EXPECT_GE(fraction, last);
      last = fraction;
      return true;
    },
    [&stage](const std::string& name, double) { stage = name; });
  EXPECT_EQ(last, 1);
  EXPECT_EQ(stage, "mesh texture");
  EXPECT_THROW(MakeTexturedModel(mesh, Views, PresetOptions("best"), 256,
                 [](const std::string&, double fraction) { return fraction < 0.4; }),
    Interrupted);
  support::ExpectError([]
    { MakeTexturedModel(support::ToPolyData({}), Views, PresetOptions("best"), 256); },
    "mesh texture: texture atlas: the mesh has no triangles");
}

TEST(ModelFiles, UnknownKindsAndTwiceTheSameAreErrors)
{
  const auto message = [](const std::vector<std::filesystem::path>& files)
  {
    try
    {
      CheckModelFiles(files, "--out");
      return std::string();
    }
    catch (const UsageError& error)
    {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(message({ "a.PLY", "b.glb" }), "") << "capitals are no other kind";
  EXPECT_EQ(message({ "a.fbx" }),
    "--out: is not a mesh file (got a.fbx, expected .glb, .obj, .ply, .vtp or .stl)");
  EXPECT_EQ(message({ "a.ply", "a.ply" }), "--out: names a file twice: a.ply");
}
