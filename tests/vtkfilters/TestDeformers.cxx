// SPDX-License-Identifier: GPL-3.0-or-later
#include "Threads.h"
#include "deformation/NonOutlineDeformation.h"
#include "deformation/OutlineDeformation.h"
#include "deformation/TsdfDeformation.h"
#include "geometry/Visibility.h"
#include "support/VtkScene.h"
#include "vtkNonOutlineDeformer.h"
#include "vtkOutlineDeformer.h"
#include "vtkTsdfNonOutlineDeformer.h"
#include "vtkTsdfOutlineDeformer.h"

#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

using namespace novelview;
using namespace support;

namespace
{
struct SphereCase
{
  std::vector<Photo> Photos = TakeAll(Sphere(Vector3d::Zero(), 0.5), Waves(0.2), Ring(12, 30));
  vtkSmartPointer<vtkMultiBlockDataSet> Blocks = ToBlocks(Photos);
  TriangleMesh Mesh = SphereMesh(Vector3d::Zero(), 0.52, 3);
  Camera Novel = OnRing(15);
  vtkSmartPointer<vtkPolyData> Poly = ToPolyData(Mesh);

  SphereCase()
  {
    vtkNew<vtkUnsignedCharArray> visible;
    visible->SetName("Visible");
    for (const std::uint8_t flag : VisibleVertices(Mesh, Novel))
    {
      visible->InsertNextValue(flag);
    }
    Poly->GetPointData()->AddArray(visible);
  }

  template <class Deformer>
  vtkSmartPointer<Deformer> With() const
  {
    auto deformer = vtkSmartPointer<Deformer>::New();
    deformer->SetInputData(0, this->Poly);
    deformer->SetInputData(1, this->Blocks);
    deformer->SetCamera(NewPinholeCamera(this->Novel));
    deformer->SetNumberOfIterations(3);
    return deformer;
  }
};

const SphereCase& TheCase()
{
  static const SphereCase sphere;
  return sphere;
}

/** Hears IterationEvents and remembers what the deformer said at each. */
class IterationLog
{
public:
  explicit IterationLog(vtkViewDeformer* deformer)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
      [](vtkObject* caller, unsigned long, void* self, void*)
      {
        auto* log = static_cast<IterationLog*>(self);
        auto* source = vtkViewDeformer::SafeDownCast(caller);
        log->Iterations.push_back(source->GetIteration());
        log->Energies.push_back(source->GetMeanEnergy());
        log->Points.push_back(Geometry(source->GetCurrentMesh()).first);
      });
    deformer->AddObserver(vtkViewDeformer::IterationEvent, this->Command);
  }
  std::vector<int> Iterations;
  std::vector<double> Energies;
  std::vector<std::vector<Vector3d>> Points;

private:
  vtkNew<vtkCallbackCommand> Command;
};

template <class Deformer>
class Deformers : public testing::Test
{
};
using Both = testing::Types<vtkOutlineDeformer, vtkNonOutlineDeformer>;

std::vector<std::string> ArraysOf(vtkOutlineDeformer*)
{
  return { "Displacement", "Energy", "EnergyPhoto", "EnergyContour", "EnergySmooth", "OutlineFlag",
    "Visible" };
}
std::vector<std::string> ArraysOf(vtkNonOutlineDeformer*)
{
  return { "Displacement", "Energy", "EnergyPhoto", "EnergyHull", "EnergySmooth", "Visible" };
}
}

TYPED_TEST_SUITE(Deformers, Both);

TYPED_TEST(Deformers, InvokeIterationEventOnceForTheStartAndEachIteration)
{
  const auto deformer = TheCase().With<TypeParam>();
  IterationLog log(deformer);
  deformer->Update();
  ASSERT_GE(log.Iterations.size(), 2u);
  for (std::size_t i = 0; i < log.Iterations.size(); ++i)
  {
    EXPECT_EQ(log.Iterations[i], static_cast<int>(i));
    EXPECT_GT(log.Energies[i], 0);
  }
  EXPECT_EQ(log.Points.front(), TheCase().Mesh.Points);
  EXPECT_EQ(log.Points.back(), Geometry(deformer->GetOutput()).first);
  EXPECT_EQ(deformer->GetIteration(), log.Iterations.back());
}

TYPED_TEST(Deformers, OutputsHoldTheNamedArraysAndTheCallersOwn)
{
  const auto deformer = TheCase().With<TypeParam>();
  deformer->Update();
  vtkPolyData* output = deformer->GetOutput();
  ASSERT_EQ(output->GetNumberOfPoints(), TheCase().Poly->GetNumberOfPoints());
  for (const std::string& name : ArraysOf(deformer))
  {
    vtkDataArray* array = output->GetPointData()->GetArray(name.c_str());
    ASSERT_TRUE(array) << name;
    EXPECT_EQ(array->GetNumberOfTuples(), output->GetNumberOfPoints()) << name;
  }
  vtkDataArray* displacement = output->GetPointData()->GetArray("Displacement");
  for (vtkIdType ptId = 0; ptId < output->GetNumberOfPoints(); ++ptId)
  {
    const Vector3d moved =
      Vector3d(output->GetPoint(ptId)) - Vector3d(TheCase().Poly->GetPoint(ptId));
    EXPECT_EQ(Vector3d(displacement->GetTuple3(ptId)), moved);
  }
}

TYPED_TEST(Deformers, RunTwiceAndOnOneOrTwoThreadsWithTheSameResult)
{
  const auto deformer = TheCase().With<TypeParam>();
  SetNumberOfThreads(1);
  deformer->Update();
  const auto first = Geometry(deformer->GetOutput());
  SetNumberOfThreads(2);
  deformer->Modified();
  deformer->Update();
  EXPECT_EQ(Geometry(deformer->GetOutput()), first);
  SetNumberOfThreads(0);
}

TYPED_TEST(Deformers, FollowTheirCameraAndLeaveTheInputAlone)
{
  const auto deformer = TheCase().With<TypeParam>();
  const vtkMTimeType inputTime = TheCase().Poly->GetMTime();
  deformer->Update();
  EXPECT_EQ(Geometry(TheCase().Poly).first, TheCase().Mesh.Points);
  EXPECT_EQ(TheCase().Poly->GetPointData()->GetNumberOfArrays(), 1);
  EXPECT_EQ(TheCase().Poly->GetMTime(), inputTime);
  const vtkMTimeType before = deformer->GetMTime();
  deformer->GetCamera()->Modified();
  EXPECT_GT(deformer->GetMTime(), before);
}

TYPED_TEST(Deformers, SayWhatIsWrong)
{
  const auto deformer = TheCase().With<TypeParam>();
  deformer->SetCamera(nullptr);
  ExpectUpdateError(deformer, "novel camera: none is set");
  deformer->SetCamera(NewPinholeCamera(TheCase().Novel));
  deformer->SetInputData(1, ToBlocks({ TheCase().Photos[0] }));
  ExpectUpdateError(deformer, "views: too few (got 1, expected at least 2)");
  const auto blocks = ToBlocks(TheCase().Photos);
  vtkImageData::SafeDownCast(blocks->GetBlock(5))->GetPointData()->RemoveArray("Color");
  deformer->SetInputData(1, blocks);
  ExpectUpdateError(deformer, "view 5 (p5): point array Color is missing");
}

TYPED_TEST(Deformers, AnEmptyMeshIsNoError)
{
  const auto deformer = TheCase().With<TypeParam>();
  deformer->SetInputData(0, ToPolyData({}));
  deformer->Update();
  EXPECT_EQ(deformer->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(deformer->GetMeanEnergy(), 0);
}

TYPED_TEST(Deformers, StopBetweenIterationsWhenAborted)
{
  const auto deformer = TheCase().With<TypeParam>();
  IterationLog log(deformer);
  EventTexts errors(deformer, vtkCommand::ErrorEvent);
  EventTexts executiveErrors(deformer->GetExecutive(), vtkCommand::ErrorEvent);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->AbortExecuteOn(); });
  deformer->AddObserver(vtkViewDeformer::IterationEvent, abort);
  deformer->Update();
  EXPECT_EQ(log.Iterations, std::vector<int>{ 0 });
}

TEST(OutlineDeformer, HandsItsParametersToTheKernel)
{
  const SphereCase& sphere = TheCase();
  const auto deformer = sphere.With<vtkOutlineDeformer>();
  deformer->SetContourWeight(0.7);
  deformer->SetSmoothWeight(0.1);
  deformer->SetSearchRange(1);
  deformer->SetWindowRadius(2);
  deformer->SetContourSigma(5);
  deformer->Update();
  OutlineOptions options;
  options.Alpha = 0.7;
  options.Beta = 0.1;
  options.SearchPx = 1;
  options.WindowRadius = 2;
  options.SigmaPx = 5;
  options.Iterations = 3;
  const auto expected = DeformOutline(sphere.Mesh, VisibleVertices(sphere.Mesh, sphere.Novel),
    ViewsOf(sphere.Photos), sphere.Novel, options);
  EXPECT_EQ(Geometry(deformer->GetOutput()).first, expected.Mesh.Points);
  EXPECT_EQ(Geometry(deformer->GetOutput()).second, expected.Mesh.Triangles);
}

TEST(NonOutlineDeformer, LeavesOutlinePointsAndInvisibleOnesWhereTheyAre)
{
  const SphereCase& sphere = TheCase();
  const auto outline = sphere.With<vtkOutlineDeformer>();
  outline->Update();
  const auto inner = sphere.With<vtkNonOutlineDeformer>();
  inner->SetInputConnection(0, outline->GetOutputPort());
  inner->Update();
  vtkPolyData* before = outline->GetOutput();
  vtkPolyData* after = inner->GetOutput();
  vtkDataArray* flags = after->GetPointData()->GetArray("OutlineFlag");
  vtkDataArray* visible = after->GetPointData()->GetArray("Visible");
  ASSERT_TRUE(flags && visible);
  int moved = 0;
  for (vtkIdType ptId = 0; ptId < after->GetNumberOfPoints(); ++ptId)
  {
    const bool stays = flags->GetComponent(ptId, 0) != 0 || visible->GetComponent(ptId, 0) == 0;
    const bool same = Vector3d(before->GetPoint(ptId)) == Vector3d(after->GetPoint(ptId));
    EXPECT_TRUE(!stays || same);
    moved += !same;
    // Displacement counts from the first input, through both filters.
    const Vector3d whole = Vector3d(after->GetPoint(ptId)) - Vector3d(sphere.Poly->GetPoint(ptId));
    const Vector3d said(after->GetPointData()->GetArray("Displacement")->GetTuple3(ptId));
    EXPECT_LT((said - whole).norm(), 1e-12);
  }
  EXPECT_GT(moved, 10);
}

namespace
{
/** The sphere's views with their true depth maps, as blocks and as the kernels take them. */
struct MappedCase
{
  vtkSmartPointer<vtkMultiBlockDataSet> Blocks = ToBlocks(TheCase().Photos);
  std::vector<View> Views;

  MappedCase()
  {
    for (unsigned int viewId = 0; viewId < Blocks->GetNumberOfBlocks(); ++viewId)
    {
      CopyToArray(TheCase().Photos[viewId].TrueDepth, arrays::Depth, ViewImage(Blocks, viewId));
      CopyToArray(Image<float>(160, 120, 1, 1.f), arrays::Confidence, ViewImage(Blocks, viewId));
    }
    ViewNeeds needs;
    needs.Color = needs.ContourDistance = true;
    Views = ReadViews(Blocks, needs);
  }

  template <class Deformer>
  vtkSmartPointer<Deformer> With() const
  {
    auto deformer = TheCase().With<Deformer>();
    deformer->SetInputData(1, this->Blocks);
    return deformer;
  }
};

/** What the kernel makes of the outline with these options. */
std::vector<Vector3d> OutlineOf(const MappedCase& mapped, TsdfDeformationOptions options)
{
  const SphereCase& sphere = TheCase();
  options.Iterations = 3;
  return DeformOutlineByField(
    sphere.Mesh, VisibleVertices(sphere.Mesh, sphere.Novel), mapped.Views, sphere.Novel, options)
    .Mesh.Points;
}

std::vector<Vector3d> Updated(vtkViewDeformer* deformer)
{
  deformer->Update();
  return Geometry(deformer->GetOutput()).first;
}
}

TEST(TsdfOutlineDeformer, ContourPredictionIsOffUntilSwitchedOn)
{
  const MappedCase mapped;
  const auto deformer = mapped.With<vtkTsdfOutlineDeformer>();
  const auto without = Updated(deformer);
  EXPECT_EQ(without, OutlineOf(mapped, OptionsForNoise(0)));
  deformer->UseContourPredictionOn();
  TsdfDeformationOptions on = OptionsForNoise(0);
  on.Silhouette.UsePrediction = true;
  const auto with = Updated(deformer);
  EXPECT_EQ(with, OutlineOf(mapped, on));
  EXPECT_NE(without, with);
}

TEST(TsdfOutlineDeformer, TakesTheNoiseAndPriorThatAreSetBeforeThoseOfTheViews)
{
  const MappedCase mapped;
  const auto deformer = mapped.With<vtkTsdfOutlineDeformer>();
  const auto plain = Updated(deformer);
  AttachNumber(mapped.Blocks, arrays::DepthNoise, 0.8);
  AttachNumber(mapped.Blocks, arrays::SilhouettePrior, 0.5);
  mapped.Blocks->Modified();
  TsdfDeformationOptions attached = OptionsForNoise(0.8);
  attached.Outline.SilhouettePrior = 0.5;
  const auto measured = Updated(deformer);
  EXPECT_EQ(measured, OutlineOf(mapped, attached));
  EXPECT_NE(measured, plain);
  deformer->SetDepthNoise(0.4);
  deformer->SetSilhouettePrior(0.9);
  TsdfDeformationOptions set = OptionsForNoise(0.4);
  set.Outline.SilhouettePrior = 0.9;
  const auto told = Updated(deformer);
  EXPECT_EQ(told, OutlineOf(mapped, set));
  EXPECT_NE(told, measured);
}

TEST(TsdfNonOutlineDeformer, FollowsTheMapsByTheNoiseThatIsSetOrMeasured)
{
  const MappedCase mapped;
  const auto deformer = mapped.With<vtkTsdfNonOutlineDeformer>();
  const auto plain = Updated(deformer);
  deformer->SetDepthNoise(0.8);
  const auto told = Updated(deformer);
  EXPECT_NE(told, plain);
  deformer->SetDepthNoise(0);
  AttachNumber(mapped.Blocks, arrays::DepthNoise, 0.8);
  mapped.Blocks->Modified();
  EXPECT_EQ(Updated(deformer), told);
}

TEST(TsdfDeformer, DepthNoiseIsClampedToItsRange)
{
  const auto outline = TheCase().With<vtkTsdfOutlineDeformer>();
  outline->SetDepthNoise(-1);
  EXPECT_EQ(outline->GetDepthNoise(), 0);
  outline->SetDepthNoise(11);
  EXPECT_EQ(outline->GetDepthNoise(), 10);
}

TEST(ViewDeformer, PrintsEveryMember)
{
  const std::vector<std::string> shared{ "Camera", "NumberOfIterations", "Iteration", "PointsMoved",
    "MeanEnergy", "MeanPhotoEnergy", "MeanContourEnergy", "MeanSmoothEnergy", "CurrentMesh" };
  const auto outline = TheCase().With<vtkOutlineDeformer>();
  ExpectPrints(outline, shared);
  ExpectPrints(
    outline, { "ContourWeight", "SmoothWeight", "SearchRange", "WindowRadius", "ContourSigma" });
  const auto inner = TheCase().With<vtkNonOutlineDeformer>();
  ExpectPrints(inner, shared);
  ExpectPrints(inner, { "SmoothWeight", "SearchRange", "WindowRadius", "MatchRange" });
  const auto tsdfOutline = TheCase().With<vtkTsdfOutlineDeformer>();
  ExpectPrints(tsdfOutline, shared);
  ExpectPrints(tsdfOutline, { "DepthNoise", "SilhouettePrior", "UseContourPrediction" });
  const auto tsdfInner = TheCase().With<vtkTsdfNonOutlineDeformer>();
  ExpectPrints(tsdfInner, shared);
  ExpectPrints(tsdfInner, { "DepthNoise" });
}
