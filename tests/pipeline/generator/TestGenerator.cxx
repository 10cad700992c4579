// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/NumberText.h"
#include "drawing/SolidTexture.h"
#include "generator/Generator.h"
#include "generator/GeneratorRig.h"

#include "mesh/ObjectMesh.h"
#include "support/MessageOf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <vtkFeatureEdges.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyDataConnectivityFilter.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace
{
using namespace novelview;
namespace fs = std::filesystem;
using testing::HasSubstr;

/** A folder that is empty at first and gone at the end. */
class Generator : public testing::Test
{
protected:
  void SetUp() override
  {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    this->Folder = fs::path(testing::TempDir()) / (std::string("novelview_") + info->name());
    fs::remove_all(this->Folder);
    fs::create_directories(this->Folder);
  }
  void TearDown() override { fs::remove_all(this->Folder); }

  cv::Mat Read(const std::string& file) const
  {
    cv::Mat image = cv::imread((this->Folder / file).string(), cv::IMREAD_UNCHANGED);
    EXPECT_FALSE(image.empty()) << file;
    return image;
  }

  void WriteFile(const std::string& name, const std::string& text) const
  {
    std::ofstream(this->Folder / name) << text;
  }

  fs::path Folder;
};

/** A rig small enough that each test takes a second. */
GeneratorOptions Small(const std::string& mesh)
{
  GeneratorOptions options;
  options.Mesh = mesh;
  options.Views = 2;
  options.Width = 96;
  options.Height = 72;
  options.Supersampling = 2;
  options.TestAnglesDeg.clear();
  return options;
}

/** Every file below a folder with its bytes. */
std::map<std::string, std::string> AllFiles(const fs::path& folder)
{
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
  {
    if (entry.is_regular_file())
    {
      std::ifstream file(entry.path(), std::ios::binary);
      std::stringstream bytes;
      bytes << file.rdbuf();
      files[fs::relative(entry.path(), folder).string()] = bytes.str();
    }
  }
  return files;
}

bool TouchesBorder(const cv::Mat& mask)
{
  return cv::countNonZero(mask.row(0)) + cv::countNonZero(mask.row(mask.rows - 1)) +
    cv::countNonZero(mask.col(0)) + cv::countNonZero(mask.col(mask.cols - 1)) >
    0;
}

TEST_F(Generator, SameOptionsSameFiles)
{
  GeneratorOptions options = Small("torus");
  options.NoiseSigma = 3;
  options.GainSpread = 0.1;
  options.CalibrationNoisePx = 0.5;
  options.TestAnglesDeg = { 10 };
  GenerateDataset(options, this->Folder / "a");
  GenerateDataset(options, this->Folder / "b");
  const auto a = AllFiles(this->Folder / "a");
  const auto b = AllFiles(this->Folder / "b");
  EXPECT_EQ(a, b);
  std::vector<std::string> names;
  for (const auto& file : a)
  {
    names.push_back(file.first);
  }
  EXPECT_THAT(names,
    testing::UnorderedElementsAre("torus0000.png", "torus0001.png", "torus_par.txt",
      "mask/torus0000.png", "mask/torus0001.png", "test/test0000.png", "test/mask/test0000.png",
      "test/test_par.txt", "truth.ply", "overview.png", "generate.json"));

  options.Seed = 1;
  GenerateDataset(options, this->Folder / "c");
  EXPECT_NE(a.at("torus0000.png"), AllFiles(this->Folder / "c").at("torus0000.png"));
}

TEST_F(Generator, CalibrationFileHoldsTheRigToTheLastBit)
{
  GeneratorOptions options = Small("part");
  options.ElevationDeg = 17;
  GenerateDataset(options, this->Folder);
  const Rig rig = MakeRig(LoadObject("part"), options);
  std::ifstream file(this->Folder / "part_par.txt");
  int count = 0;
  file >> count;
  ASSERT_EQ(count, 2);
  for (const Camera& camera : rig.Views)
  {
    std::string name;
    file >> name;
    EXPECT_TRUE(fs::exists(this->Folder / name));
    for (const Eigen::MatrixXd& matrix :
      { Eigen::MatrixXd(camera.K), Eigen::MatrixXd(camera.R), Eigen::MatrixXd(camera.T) })
    {
      for (int i = 0; i < matrix.size(); ++i)
      {
        double value = 0;
        file >> value;
        EXPECT_EQ(value, matrix(i / matrix.cols(), i % matrix.cols()));
      }
    }
  }
}

TEST_F(Generator, ObjectFillsTheFrameAsAsked)
{
  GeneratorOptions options = Small("bust");
  options.Views = 5;
  options.StepDeg = 72;
  GenerateDataset(options, this->Folder);
  double largest = 0;
  for (int viewId = 0; viewId < 5; ++viewId)
  {
    const cv::Mat mask = this->Read("mask/bust000" + std::to_string(viewId) + ".png");
    std::vector<cv::Point> inside;
    cv::findNonZero(mask > 127, inside);
    const cv::Rect box = cv::boundingRect(inside);
    const double half = std::max({ std::abs(box.x - 48) / 48.0, std::abs(box.br().x - 48) / 48.0,
      std::abs(box.y - 36) / 36.0, std::abs(box.br().y - 36) / 36.0 });
    largest = std::max(largest, half);
  }
  EXPECT_NEAR(largest, 0.75, 1.0 / 36); // to a pixel
}

TEST_F(Generator, RigIsACircleAroundTheObject)
{
  vtkSmartPointer<vtkPolyData> mesh = LoadObject("part"); // its box's centre is the origin
  GeneratorOptions options = Small("part");
  options.Views = 12;
  options.ElevationDeg = 20;
  options.TestAnglesDeg = { 15 };
  const Rig rig = MakeRig(mesh, options);
  ASSERT_EQ(rig.Views.size(), 12u);
  ASSERT_EQ(rig.Tests.size(), 1u);
  const double radius = rig.Views[0].Centre().norm();
  for (const Camera& camera : rig.Views)
  {
    EXPECT_NEAR(camera.Centre().norm(), radius, 1e-9 * radius);
    EXPECT_NEAR(camera.Centre().y(), radius * std::sin(EIGEN_PI / 9), 1e-9 * radius);
    EXPECT_LT((camera.Project({ 0, 0, 0 }) - Eigen::Vector2d(47.5, 35.5)).norm(), 1e-9);
  }
  // Camera 0 on +z, the next ones towards +x, the test view between the first two.
  EXPECT_NEAR(rig.Views[0].Centre().x(), 0, 1e-9 * radius);
  EXPECT_GT(rig.Views[0].Centre().z(), 0);
  EXPECT_GT(rig.Views[1].Centre().x(), 0);
  const Camera between = InterpolateOnOrbit(rig.Views[0], rig.Views[1], 0.5);
  EXPECT_LT((between.Centre() - rig.Tests[0].Centre()).norm(), 1e-9 * radius);
}

TEST_F(Generator, FrameShiftTakesTheObjectOutOfSomeFrames)
{
  GeneratorOptions options = Small("torus");
  options.Views = 4;
  options.FrameShift = 0.4;
  GenerateDataset(options, this->Folder);
  for (int viewId = 0; viewId < 4; ++viewId)
  {
    const cv::Mat mask = this->Read("mask/torus000" + std::to_string(viewId) + ".png");
    EXPECT_EQ(TouchesBorder(mask), viewId % 3 == 0) << viewId;
    EXPECT_GT(cv::countNonZero(mask), 0);
  }
}

TEST_F(Generator, ShadowBreaksThresholdingButNotTheExactMask)
{
  GeneratorOptions options = Small("bust");
  options.Texture = "grey";
  options.ShadowViews = { 1 };
  GenerateDataset(options, this->Folder / "exact");
  options.Masks = "threshold";
  GenerateDataset(options, this->Folder / "threshold");
  const auto pixels = [this](const std::string& file)
  { return cv::countNonZero(this->Read(file) > 127); };
  const int exact = pixels("exact/mask/bust0001.png");
  // The shadow takes the shoulders; without it only the boundary, whose pixels are less than half
  // covered but bright enough, may differ.
  EXPECT_LT(pixels("threshold/mask/bust0001.png"), 0.8 * exact);
  EXPECT_NEAR(
    pixels("threshold/mask/bust0000.png"), pixels("exact/mask/bust0000.png"), 0.1 * exact);

  options.Masks = "none";
  GenerateDataset(options, this->Folder / "none");
  EXPECT_FALSE(fs::exists(this->Folder / "none" / "mask"));
}

TEST_F(Generator, MasksAreErodedAndGrownWhereAsked)
{
  GeneratorOptions options = Small("torus");
  GenerateDataset(options, this->Folder / "exact");
  options.MaskErodePx = 3;
  options.MaskErodeViews = { 0 };
  GenerateDataset(options, this->Folder / "eroded");
  options.MaskErodePx = -2;
  GenerateDataset(options, this->Folder / "grown");
  const cv::Mat exact = this->Read("exact/mask/torus0000.png") > 127;
  const cv::Mat eroded = this->Read("eroded/mask/torus0000.png") > 127;
  const cv::Mat grown = this->Read("grown/mask/torus0000.png") > 127;
  cv::Mat depth;
  cv::distanceTransform(exact, depth, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  double most = 0;
  cv::minMaxLoc(depth, nullptr, &most, nullptr, nullptr, ~eroded);
  EXPECT_NEAR(most, 3, 1); // what was taken away is three pixels wide, on the pixel grid
  EXPECT_EQ(cv::countNonZero(eroded & ~exact), 0);
  EXPECT_EQ(cv::countNonZero(exact & ~grown), 0);
  EXPECT_GT(cv::countNonZero(grown), cv::countNonZero(exact));
  EXPECT_EQ(cv::countNonZero(
              this->Read("exact/mask/torus0001.png") != this->Read("eroded/mask/torus0001.png")),
    0);
}

TEST_F(Generator, GainAndNoiseAreAsStrongAsAsked)
{
  GeneratorOptions options = Small("torus");
  options.Texture = "grey";
  options.Lit = false;
  options.Views = 6;
  options.Width = 240;
  options.Height = 180;
  options.TestAnglesDeg = { 0 };
  options.NoiseSigma = 5;
  options.GainSpread = 0.2;
  GenerateDataset(options, this->Folder);
  double least = 2;
  double most = 0;
  for (int viewId = 0; viewId < 6; ++viewId)
  {
    const std::string name = "torus000" + std::to_string(viewId) + ".png";
    cv::Scalar mean;
    cv::Scalar deviation;
    cv::meanStdDev(this->Read(name), mean, deviation, this->Read("mask/" + name) == 255);
    EXPECT_NEAR(deviation[0], 5, 0.3); // of thousands of pixels
    least = std::min(least, mean[0] / 133);
    most = std::max(most, mean[0] / 133);
  }
  EXPECT_GT(least, 0.79);
  EXPECT_LT(most, 1.21);
  EXPECT_GT(most - least, 0.05); // six equal gains would be a broken generator
  const cv::Mat truth = this->Read("test/test0000.png");
  const cv::Mat solid = this->Read("test/mask/test0000.png") == 255;

  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(truth, mean, deviation, solid);
  EXPECT_EQ(deviation[0], 0) << "held-out views are perfect";
  EXPECT_EQ(mean[0], 133);
}

TEST_F(Generator, CalibrationNoiseTurnsTheWrittenCamerasOnly)
{
  vtkSmartPointer<vtkPolyData> mesh = LoadObject("torus");
  GeneratorOptions options = Small("torus");
  options.Views = 200;
  options.StepDeg = 1.8;
  options.CalibrationNoisePx = 0.7;
  const Rig rig = MakeRig(mesh, options);
  double sum = 0;
  for (std::size_t i = 0; i < rig.Views.size(); ++i)
  {
    EXPECT_LT((rig.Views[i].Centre() - rig.Written[i].Centre()).norm(), 1e-9);
    sum += (rig.Written[i].Project({ 0, 0, 0 }) - rig.Views[i].Project({ 0, 0, 0 })).squaredNorm();
  }
  // Two independent axes of 0.7 px each; 200 draws of a mean square scatter by 1 / sqrt(200) = 7 %.
  EXPECT_NEAR(sum / 200, 2 * 0.7 * 0.7, 0.25 * 2 * 0.7 * 0.7);
}

TEST_F(Generator, TruthIsTheMesh)
{
  GenerateDataset(Small("bust"), this->Folder);
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName((this->Folder / "truth.ply").c_str());
  reader->Update();
  vtkSmartPointer<vtkPolyData> mesh = LoadObject("bust");
  ASSERT_EQ(reader->GetOutput()->GetNumberOfPoints(), mesh->GetNumberOfPoints());
  ASSERT_EQ(reader->GetOutput()->GetNumberOfPolys(), mesh->GetNumberOfPolys());
  for (vtkIdType ptId = 0; ptId < mesh->GetNumberOfPoints(); ptId += 97)
  {
    for (int c = 0; c < 3; ++c)
    {
      ASSERT_EQ(reader->GetOutput()->GetPoint(ptId)[c], mesh->GetPoint(ptId)[c]);
    }
  }
}

TEST_F(Generator, WritesDownItsOptions)
{
  GeneratorOptions options = Small("torus");
  options.Seed = 42;
  options.ShadowViews = { 1 };
  GenerateDataset(options, this->Folder);
  const auto json = nlohmann::json::parse(std::ifstream(this->Folder / "generate.json"));
  EXPECT_EQ(json.at("mesh"), "torus");
  EXPECT_EQ(json.at("seed"), 42);
  EXPECT_EQ(json.at("size"), (std::vector<int>{ 96, 72 }));
  EXPECT_EQ(json.at("shadow_views"), (std::vector<int>{ 1 }));
  EXPECT_EQ(json.at("shadow_darkness"), 0.96);
}

TEST_F(Generator, ReportsProgressAndStopsWhenAsked)
{
  double last = -1;
  GenerateDataset(Small("torus"), this->Folder,
    [&last](const std::string&, double fraction)
    {
      EXPECT_GE(fraction, last);
      last = fraction;
      return true;
    });
  EXPECT_EQ(last, 1);
  EXPECT_THROW(GenerateDataset(Small("torus"), this->Folder / "b",
                 [](const std::string&, double fraction) { return fraction < 0.5; }),
    Interrupted);
}

TEST_F(Generator, RefusesWrongOptions)
{
  const auto message = [this](const std::function<void(GeneratorOptions&)>& change)
  {
    GeneratorOptions options = Small("torus");
    change(options);
    const std::string text = MessageOf([&] { GenerateDataset(options, this->Folder / "x"); });
    EXPECT_FALSE(fs::exists(this->Folder / "x")) << "nothing is written";
    return text;
  };
  using Options = GeneratorOptions;
  EXPECT_THAT(message([](Options& o) { o.Texture = "woood"; }),
    HasSubstr("generate, texture: is not a valid choice (got 'woood', expected " +
      Joined(TextureNames()) + ")"));
  EXPECT_THAT(message([](Options& o) { o.Masks = "some"; }),
    HasSubstr("masks: is not a valid choice (got 'some'"));
  EXPECT_THAT(message([](Options& o) { o.Views = 0; }),
    HasSubstr("views: is out of range (got 0, expected 1 to 10000)"));
  EXPECT_THAT(message([](Options& o) { o.Width = -3; }),
    HasSubstr("size: is out of range (got -3, expected 16 to 16384)"));
  EXPECT_THAT(message([](Options& o) { o.ElevationDeg = 90; }),
    HasSubstr("elevation: is out of range (got 90, expected -89 to 89)"));
  EXPECT_THAT(
    message([](Options& o) { o.NoiseSigma = std::nan(""); }), HasSubstr("noise: is out of range"));
  EXPECT_THAT(message([](Options& o) { o.ShadowViews = { 2 }; }),
    HasSubstr("view of the shadow is out of range (got 2, expected 0 to 1)"));
  EXPECT_THAT(message([](Options& o) { o.TestAnglesDeg = { INFINITY }; }),
    HasSubstr("testAngles: is not finite (got inf"));
}

TEST_F(Generator, SaysThatTheFolderCannotBeWritten)
{
  EXPECT_THAT(MessageOf([] { GenerateDataset(Small("torus"), "/proc/novelview"); }),
    HasSubstr("/proc/novelview: cannot make the folder"));
}

TEST_F(Generator, RefusesMeshesThatAreNone)
{
  const auto message = [this](const std::string& name)
  { return MessageOf([&] { LoadObject((this->Folder / name).string()); }); };
  EXPECT_THAT(message("absent.ply"), HasSubstr("mesh file does not exist"));
  this->WriteFile("notes.txt", "hello");
  EXPECT_THAT(message("notes.txt"), HasSubstr("unknown kind of mesh file (got \".txt\""));
  for (const char* name : { "bad.ply", "bad.stl", "bad.obj", "bad.vtp" })
  {
    for (const char* text : { "this is no mesh\n", "" })
    {
      this->WriteFile(name, text);
      EXPECT_THAT(message(name), HasSubstr(name)) << "more in TestMeshFile.cxx";
    }
  }
  this->WriteFile("flat.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n");
  EXPECT_THAT(message("flat.obj"), HasSubstr("contains no triangles"));
  this->WriteFile("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_THAT(message("nan.obj"), HasSubstr("not finite"));
}

TEST_F(Generator, AcceptsEveryKindOfMeshFile)
{
  this->WriteFile("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  this->WriteFile("tri.stl",
    "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    "endloop\nendfacet\nendsolid t\n");
  this->WriteFile("tri.ply",
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(LoadObject((this->Folder / "square.obj").string())->GetNumberOfPolys(), 2);
  EXPECT_EQ(LoadObject((this->Folder / "tri.stl").string())->GetNumberOfPolys(), 1);
  EXPECT_EQ(LoadObject((this->Folder / "tri.ply").string())->GetNumberOfPolys(), 1);
}

TEST_F(Generator, BuiltinObjectsAreClosedAndOfTheRightGenus)
{
  // The stool's four legs, joined by four rungs below and the seat above, make four handles.
  const std::map<std::string, int> genus = { { "bunny", 0 }, { "part", 1 }, { "stool", 4 },
    { "bust", 0 }, { "torus", 1 }, { "lattice", 28 } };
  for (const std::string& name : BuiltinObjects())
  {
    vtkSmartPointer<vtkPolyData> mesh = LoadObject(name);
    vtkNew<vtkFeatureEdges> edges;
    edges->SetInputData(mesh);
    edges->FeatureEdgesOff();
    edges->Update();
    EXPECT_EQ(edges->GetOutput()->GetNumberOfCells(), 0) << name << " is closed and manifold";
    vtkNew<vtkPolyDataConnectivityFilter> parts;
    parts->SetInputData(mesh);
    parts->SetExtractionModeToAllRegions();
    parts->Update();
    EXPECT_EQ(parts->GetNumberOfExtractedRegions(), 1) << name;
    const vtkIdType triangles = mesh->GetNumberOfPolys();
    const vtkIdType euler = mesh->GetNumberOfPoints() - triangles / 2; // V - 3/2 F + F
    EXPECT_EQ(euler, 2 - 2 * genus.at(name)) << name;
    double volume = 0;
    for (vtkIdType cellId = 0; cellId < triangles; ++cellId)
    {
      vtkNew<vtkIdList> ids;
      mesh->GetCellPoints(cellId, ids);
      const Eigen::Vector3d a(mesh->GetPoint(ids->GetId(0)));
      const Eigen::Vector3d b(mesh->GetPoint(ids->GetId(1)));
      const Eigen::Vector3d c(mesh->GetPoint(ids->GetId(2)));
      volume += a.dot(b.cross(c)) / 6;
    }
    EXPECT_GT(volume, 0) << name << " is turned outwards";
  }
}
}
