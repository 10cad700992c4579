// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/CalibrationScene.h"
#include "support/VtkScene.h"
#include "vtkCameraRefiner.h"

#include <vtkPointData.h>

using namespace novelview;
using namespace support;

namespace
{
/** The photographs as blocks, with their true depth maps if wanted. */
vtkSmartPointer<vtkMultiBlockDataSet> Blocks(const CalibrationScene& scene, bool withDepth)
{
  auto blocks = ToBlocks(scene.Photos);
  for (unsigned int i = 0; withDepth && i < blocks->GetNumberOfBlocks(); ++i)
  {
    const Image<float>& depth = scene.Photos[i].TrueDepth;
    CopyToArray(depth, arrays::Depth, ViewImage(blocks, i));
    CopyToArray(
      Image<float>(depth.Width, depth.Height, 1, 1.f), arrays::Confidence, ViewImage(blocks, i));
  }
  return blocks;
}

vtkSmartPointer<vtkCameraRefiner> RefinerOf(const CalibrationScene& scene)
{
  auto refiner = vtkSmartPointer<vtkCameraRefiner>::New();
  refiner->SetInputData(0, Blocks(scene, false));
  refiner->SetInputData(1, Blocks(scene, true));
  return refiner;
}

Camera CameraOf(vtkDataObject* blocks, unsigned int viewId)
{
  return AttachedCamera(ViewImage(vtkMultiBlockDataSet::SafeDownCast(blocks), viewId), "view");
}
}

TEST(CameraRefiner, ReplacesTheCamerasAndNothingElse)
{
  CalibrationScene scene(Waves(0.06));
  scene.Disturb(0.75);
  const auto refiner = RefinerOf(scene);
  refiner->Update();
  ASSERT_TRUE(refiner->GetRefined());
  EXPECT_LT(refiner->GetErrorAfter(), 0.5 * refiner->GetErrorBefore());
  vtkMultiBlockDataSet* output = refiner->GetOutput();
  ASSERT_EQ(output->GetNumberOfBlocks(), scene.Photos.size());
  for (unsigned int i = 0; i < scene.Photos.size(); ++i)
  {
    vtkImageData* image = ViewImage(output, i);
    EXPECT_EQ(ViewName(output, i), scene.Photos[i].Name);
    EXPECT_GT(AttachedNumber(image, arrays::CameraShift, 0), 0);
    EXPECT_NE(CameraOf(output, i).R, scene.Photos[i].Cam.R);
    EXPECT_EQ(CameraOf(refiner->GetInputDataObject(0, 0), i).R, scene.Photos[i].Cam.R)
      << "the input stays as it is";
    EXPECT_FALSE(image->GetPointData()->HasArray(arrays::Depth)) << "the depth maps are outdated";
    EXPECT_EQ(image->GetPointData()->GetArray(arrays::Color),
      ViewImage(vtkMultiBlockDataSet::SafeDownCast(refiner->GetInputDataObject(0, 0)), i)
        ->GetPointData()
        ->GetArray(arrays::Color));
  }
}

TEST(CameraRefiner, LeavesExactCamerasAlone)
{
  const CalibrationScene scene(Waves(0.06));
  const auto refiner = RefinerOf(scene);
  refiner->Update();
  EXPECT_FALSE(refiner->GetRefined());
  for (unsigned int i = 0; i < scene.Photos.size(); ++i)
  {
    EXPECT_EQ(CameraOf(refiner->GetOutput(), i).R, scene.Photos[i].Cam.R);
    EXPECT_EQ(AttachedNumber(ViewImage(refiner->GetOutput(), i), arrays::CameraShift, -1), 0);
  }
}

TEST(CameraRefiner, AGainThatIsOutOfReachRejects)
{
  CalibrationScene scene(Waves(0.06));
  scene.Disturb(0.75);
  const auto refiner = RefinerOf(scene);
  refiner->SetMinGain(1);
  refiner->Update();
  EXPECT_FALSE(refiner->GetRefined());
}

TEST(CameraRefiner, ViewsWithoutDepthMapsAreAnError)
{
  const CalibrationScene scene(Waves(0.06));
  vtkNew<vtkCameraRefiner> refiner;
  refiner->SetInputData(0, Blocks(scene, false));
  refiner->SetInputData(1, Blocks(scene, false));
  ExpectUpdateError(refiner, "Depth or Confidence is missing");
}
