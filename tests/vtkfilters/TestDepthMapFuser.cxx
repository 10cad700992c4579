// SPDX-License-Identifier: GPL-3.0-or-later
#include "Threads.h"
#include "fusion/FusedSurface.h"
#include "support/VtkScene.h"
#include "vtkDepthMapFuser.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>

using namespace novelview;
using namespace support;

namespace
{
/** A ball with its true depth maps, in a hull that is two pixels too large. */
struct BallCase
{
  std::vector<Photo> Photos = TakeAll(Sphere(Vector3d::Zero(), 0.5), Waves(0.3), Ring(8, 45));
  vtkSmartPointer<vtkMultiBlockDataSet> Blocks = ToBlocks(Photos);
  std::vector<View> Views;
  TriangleMesh Hull = SphereMesh(Vector3d::Zero(), 0.52, 3);

  BallCase()
  {
    for (unsigned int viewId = 0; viewId < Blocks->GetNumberOfBlocks(); ++viewId)
    {
      CopyToArray(Photos[viewId].TrueDepth, arrays::Depth, ViewImage(Blocks, viewId));
      CopyToArray(Image<float>(160, 120, 1, 1.f), arrays::Confidence, ViewImage(Blocks, viewId));
    }
    ViewNeeds needs;
    needs.Color = needs.ContourDistance = true;
    Views = ReadViews(Blocks, needs);
  }

  vtkSmartPointer<vtkDepthMapFuser> Fuser() const
  {
    auto fuser = vtkSmartPointer<vtkDepthMapFuser>::New();
    fuser->SetInputData(0, ToPolyData(this->Hull));
    fuser->SetInputData(1, this->Blocks);
    return fuser;
  }
  TriangleMesh Fused(double noise) const
  {
    FusedSurfaceOptions options;
    options.DepthNoise = noise;
    return FuseDepthMaps(this->Hull.Points, this->Views, options).Mesh;
  }
};

const BallCase& TheCase()
{
  static const BallCase ball;
  return ball;
}
}

TEST(DepthMapFuser, MakesTheMeshOfTheKernel)
{
  const BallCase& ball = TheCase();
  const auto fuser = ball.Fuser();
  fuser->Update();
  const TriangleMesh expected = ball.Fused(0);
  EXPECT_EQ(Geometry(fuser->GetOutput()).first, expected.Points);
  EXPECT_EQ(Geometry(fuser->GetOutput()).second, expected.Triangles);
  EXPECT_EQ(fuser->GetNumberOfDroppedComponents(), 0);
}

TEST(DepthMapFuser, SpacingIsThatOfThePoints)
{
  const auto fuser = TheCase().Fuser();
  fuser->Update();
  const vtkIdType fine = fuser->GetOutput()->GetNumberOfPoints();
  fuser->SetSampleSpacing(2 * fuser->GetSampleSpacing());
  fuser->Update();
  const vtkIdType coarse = fuser->GetOutput()->GetNumberOfPoints();
  EXPECT_NEAR(static_cast<double>(fine) / coarse, 4, 0.5) << "points on a surface";
}

TEST(DepthMapFuser, TakesTheNoiseThatIsSetBeforeThatOfTheViews)
{
  const BallCase ball;
  AttachNumber(ball.Blocks, arrays::DepthNoise, 0.8);
  const auto fuser = ball.Fuser();
  fuser->Update();
  const auto measured = Geometry(fuser->GetOutput()).first;
  EXPECT_EQ(measured, ball.Fused(0.8).Points);
  fuser->SetDepthNoise(0.4);
  fuser->Update();
  EXPECT_EQ(Geometry(fuser->GetOutput()).first, ball.Fused(0.4).Points);
  EXPECT_NE(Geometry(fuser->GetOutput()).first, measured);
}

TEST(DepthMapFuser, RunsTwiceTheSameAndLeavesTheInputAlone)
{
  const auto fuser = TheCase().Fuser();
  SetNumberOfThreads(1);
  fuser->Update();
  const auto first = Geometry(fuser->GetOutput());
  EXPECT_EQ(Geometry(vtkPolyData::SafeDownCast(fuser->GetInputDataObject(0, 0))).first,
    TheCase().Hull.Points);
  SetNumberOfThreads(2);
  fuser->Modified();
  fuser->Update();
  EXPECT_EQ(Geometry(fuser->GetOutput()), first);
  SetNumberOfThreads(0);
}

TEST(DepthMapFuser, SaysWhatIsWrongAndRecovers)
{
  const auto fuser = TheCase().Fuser();
  fuser->SetInputData(1, ToBlocks(TheCase().Photos));
  ExpectUpdateError(fuser, "view p0: point array Depth or Confidence is missing");
  fuser->SetInputData(1, TheCase().Blocks);
  fuser->Update();
  EXPECT_GT(fuser->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(DepthMapFuser, StopsWhenAborted)
{
  const auto fuser = TheCase().Fuser();
  EventTexts errors(fuser, vtkCommand::ErrorEvent);
  EventTexts executiveErrors(fuser->GetExecutive(), vtkCommand::ErrorEvent);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->AbortExecuteOn(); });
  fuser->AddObserver(vtkCommand::ProgressEvent, abort);
  fuser->Update();
  EXPECT_EQ(fuser->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(DepthMapFuser, PrintsEveryMember)
{
  ExpectPrints(TheCase().Fuser(),
    { "DepthNoise", "SampleSpacing", "KeepAllComponents", "NumberOfDroppedComponents",
      "NumberOfDroppedTriangles" });
}
