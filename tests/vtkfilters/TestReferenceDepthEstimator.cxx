// SPDX-License-Identifier: GPL-3.0-or-later
#include "Threads.h"
#include "deformation/TsdfDeformation.h"
#include "fusion/SilhouettePrior.h"
#include "geometry/ViewSelection.h"
#include "stereo/MapComparison.h"
#include "stereo/ReferenceDepth.h"
#include "support/VtkScene.h"
#include "vtkReferenceDepthEstimator.h"

#include <vtkFieldData.h>
#include <vtkPointData.h>

using namespace novelview;
using namespace support;

namespace
{
struct SphereCase
{
  std::vector<Photo> Photos = TakeAll(Sphere(Vector3d::Zero(), 0.5), Waves(0.2), Ring(4, 25));
  vtkSmartPointer<vtkMultiBlockDataSet> Blocks = ToBlocks(Photos);
  TriangleMesh Hull = SphereMesh(Vector3d::Zero(), 0.53, 3);

  vtkSmartPointer<vtkReferenceDepthEstimator> Estimator() const
  {
    auto estimator = vtkSmartPointer<vtkReferenceDepthEstimator>::New();
    estimator->SetInputData(0, this->Blocks);
    estimator->SetInputData(1, ToPolyData(this->Hull));
    estimator->SetSearchDepth(40);
    return estimator;
  }
};

const SphereCase& TheCase()
{
  static const SphereCase sphere;
  return sphere;
}

std::vector<float> DepthsOf(vtkMultiBlockDataSet* views)
{
  std::vector<float> values;
  for (const View& view : ReadViews(views, {}))
  {
    for (int y = 0; y < view.DepthMap.Height; ++y)
    {
      values.insert(values.end(), view.DepthMap.Row(y), view.DepthMap.Row(y) + view.DepthMap.Width);
    }
  }
  return values;
}
}

TEST(ReferenceDepthEstimator, AddsTheKernelsMapsToTheSameViews)
{
  const SphereCase& sphere = TheCase();
  const auto estimator = sphere.Estimator();
  estimator->SetNeighbours(2);
  estimator->SetWindowRadius(3);
  estimator->SetColorShare(0.25);
  estimator->Update();
  ReferenceDepthOptions options;
  options.Neighbours = 2;
  options.CoarseLastPx = 40;
  options.Match.WindowRadius = 3;
  options.Match.ColorShare = 0.25;
  const auto expected = EstimateReferenceDepths(ViewsOf(sphere.Photos), sphere.Hull, options);
  const auto views = ReadViews(estimator->GetOutput(), {});
  ASSERT_EQ(views.size(), 4u);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    EXPECT_EQ(views[i].Name, sphere.Photos[i].Name);
    EXPECT_EQ(views[i].Cam.R, sphere.Photos[i].Cam.R);
    EXPECT_EQ(views[i].Mask(80, 60), 255);
    for (int y = 0; y < 120; y += 5)
    {
      for (int x = 0; x < 160; x += 5)
      {
        EXPECT_EQ(views[i].DepthMap(x, y), expected[i].Depth(x, y));
        EXPECT_EQ(views[i].Confidence(x, y), expected[i].Confidence(x, y));
      }
    }
  }
}

TEST(ReferenceDepthEstimator, LeavesTheInputAloneAndRunsTwice)
{
  const SphereCase& sphere = TheCase();
  const auto estimator = sphere.Estimator();
  SetNumberOfThreads(1);
  estimator->Update();
  const auto first = DepthsOf(estimator->GetOutput());
  ASSERT_EQ(first.size(), 4u * 160 * 120);
  auto* image = vtkImageData::SafeDownCast(sphere.Blocks->GetBlock(0));
  EXPECT_FALSE(image->GetPointData()->HasArray("Depth"));
  SetNumberOfThreads(2);
  estimator->Modified();
  estimator->Update();
  EXPECT_EQ(DepthsOf(estimator->GetOutput()), first);
  SetNumberOfThreads(0);
}

TEST(ReferenceDepthEstimator, AttachesWhatTheMapsTellOfEachOther)
{
  const SphereCase& sphere = TheCase();
  const auto estimator = sphere.Estimator();
  estimator->Update();
  vtkMultiBlockDataSet* output = estimator->GetOutput();
  const auto views = ReadViews(output, {});
  const double footprint = MedianFootprint(views, Vector3d::Zero());
  const double noise = DepthNoise(views, footprint);
  EXPECT_GT(noise, 0);
  EXPECT_EQ(AttachedNumber(output, arrays::DepthNoise, -1), noise);
  SilhouettePriorOptions prior;
  prior.Fusion = OptionsForNoise(noise).Outline;
  prior.Noise = noise;
  EXPECT_EQ(AttachedNumber(output, arrays::SilhouettePrior, -1),
    FindSilhouettePrior(views, sphere.Hull, prior));
  for (unsigned int viewId = 0; viewId < views.size(); ++viewId)
  {
    // The exposures are the same; what is measured beyond that would predict nothing.
    EXPECT_EQ(AttachedNumber(ViewImage(output, viewId), arrays::ExposureGain, -1), 1);
    EXPECT_EQ(views[viewId].Gain, 1);
    EXPECT_FALSE(ViewImage(sphere.Blocks, viewId)->GetFieldData()->HasArray(arrays::ExposureGain))
      << "the input is left alone";
  }
  EXPECT_FALSE(sphere.Blocks->GetFieldData()->HasArray(arrays::DepthNoise));
}

TEST(ReferenceDepthEstimator, FindsABrighterPhotograph)
{
  auto photos = TheCase().Photos;
  for (std::uint8_t& value : photos[2].Color.Values)
  {
    value = static_cast<std::uint8_t>(std::lround(0.9 * value));
  }
  const auto estimator = TheCase().Estimator();
  estimator->SetInputData(0, ToBlocks(photos));
  estimator->Update();
  const auto views = ReadViews(estimator->GetOutput(), {});
  const double mean = std::pow(0.9, 0.25);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    // Estimated maps are off by some tenths of a footprint, which shifts colours either way.
    EXPECT_NEAR(views[i].Gain, (i == 2 ? 0.9 : 1) / mean, 0.015) << i;
  }
}

TEST(ReferenceDepthEstimator, WithoutMapsThereIsNothingToCompare)
{
  const auto estimator = TheCase().Estimator();
  estimator->SetInputData(1, ToPolyData({}));
  estimator->Update();
  EXPECT_FALSE(estimator->GetOutput()->GetFieldData()->HasArray(arrays::DepthNoise));
  EXPECT_EQ(ReadViews(estimator->GetOutput(), {})[0].Gain, 1);
}

TEST(ReferenceDepthEstimator, AnEmptyHullGivesUnknownDepthsAndNoRubbish)
{
  const auto estimator = TheCase().Estimator();
  estimator->SetInputData(1, ToPolyData({}));
  estimator->Update();
  EXPECT_THAT(DepthsOf(estimator->GetOutput()), testing::Each(0.f));
}

TEST(ReferenceDepthEstimator, SaysWhatIsWrong)
{
  const auto estimator = TheCase().Estimator();
  estimator->SetInputData(0, ToBlocks({ TheCase().Photos[0] }));
  ExpectUpdateError(estimator, "views: too few (got 1, expected at least 2)");
  const auto blocks = ToBlocks(TheCase().Photos);
  vtkImageData::SafeDownCast(blocks->GetBlock(3))->GetPointData()->RemoveArray("ContourDistance");
  estimator->SetInputData(0, blocks);
  ExpectUpdateError(estimator, "view 3 (p3): point array ContourDistance is missing");
}

TEST(ReferenceDepthEstimator, PrintsEveryMember)
{
  ExpectPrints(
    TheCase().Estimator(), { "Neighbours", "SearchDepth", "WindowRadius", "ColorShare" });
}
