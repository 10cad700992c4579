// SPDX-License-Identifier: GPL-3.0-or-later
#include "Threads.h"
#include "deformation/TsdfDeformation.h"
#include "fusion/ModelRefinement.h"
#include "support/VtkScene.h"
#include "vtkWholeObjectRefiner.h"

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

  vtkSmartPointer<vtkWholeObjectRefiner> Refiner() const
  {
    auto refiner = vtkSmartPointer<vtkWholeObjectRefiner>::New();
    refiner->SetInputData(0, ToPolyData(this->Hull));
    refiner->SetInputData(1, this->Blocks);
    return refiner;
  }
  TriangleMesh Refined(double noise) const
  {
    ModelRefinementOptions options;
    options.Fusion = OptionsForNoise(noise).Surface;
    return RefineModel(this->Hull, this->Views, options);
  }
};

const BallCase& TheCase()
{
  static const BallCase ball;
  return ball;
}
}

TEST(WholeObjectRefiner, MovesThePointsWhereTheKernelDoes)
{
  const BallCase& ball = TheCase();
  const auto refiner = ball.Refiner();
  refiner->Update();
  const TriangleMesh expected = ball.Refined(0);
  EXPECT_EQ(Geometry(refiner->GetOutput()).first, expected.Points);
  EXPECT_EQ(Geometry(refiner->GetOutput()).second, ball.Hull.Triangles);
  double before = 0;
  double after = 0;
  for (std::size_t ptId = 0; ptId < expected.Points.size(); ++ptId)
  {
    before += std::abs(ball.Hull.Points[ptId].norm() - 0.5);
    after += std::abs(expected.Points[ptId].norm() - 0.5);
  }
  EXPECT_LT(after, before / 2) << "towards the ball";
}

TEST(WholeObjectRefiner, TakesTheNoiseThatIsSetBeforeThatOfTheViews)
{
  const BallCase ball;
  AttachNumber(ball.Blocks, arrays::DepthNoise, 0.8);
  const auto refiner = ball.Refiner();
  refiner->Update();
  const auto measured = Geometry(refiner->GetOutput()).first;
  EXPECT_EQ(measured, ball.Refined(0.8).Points);
  refiner->SetDepthNoise(0.4);
  refiner->Update();
  EXPECT_EQ(Geometry(refiner->GetOutput()).first, ball.Refined(0.4).Points);
  EXPECT_NE(Geometry(refiner->GetOutput()).first, measured);
}

TEST(WholeObjectRefiner, RunsTwiceTheSameAndLeavesTheInputAlone)
{
  const auto refiner = TheCase().Refiner();
  SetNumberOfThreads(1);
  refiner->Update();
  const auto first = Geometry(refiner->GetOutput());
  EXPECT_EQ(Geometry(vtkPolyData::SafeDownCast(refiner->GetInputDataObject(0, 0))).first,
    TheCase().Hull.Points);
  SetNumberOfThreads(2);
  refiner->Modified();
  refiner->Update();
  EXPECT_EQ(Geometry(refiner->GetOutput()), first);
  SetNumberOfThreads(0);
}

TEST(WholeObjectRefiner, SaysWhatIsWrongAndRecovers)
{
  const auto refiner = TheCase().Refiner();
  refiner->SetInputData(1, ToBlocks(TheCase().Photos));
  ExpectUpdateError(refiner, "view p0: point array Depth or Confidence is missing");
  refiner->SetInputData(1, TheCase().Blocks);
  refiner->Update();
  EXPECT_GT(refiner->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(WholeObjectRefiner, StopsWhenAborted)
{
  const auto refiner = TheCase().Refiner();
  EventTexts errors(refiner, vtkCommand::ErrorEvent);
  EventTexts executiveErrors(refiner->GetExecutive(), vtkCommand::ErrorEvent);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->AbortExecuteOn(); });
  refiner->AddObserver(vtkCommand::ProgressEvent, abort);
  refiner->Update();
  EXPECT_EQ(refiner->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(WholeObjectRefiner, PrintsEveryMember)
{
  ExpectPrints(TheCase().Refiner(), { "DepthNoise" });
}
