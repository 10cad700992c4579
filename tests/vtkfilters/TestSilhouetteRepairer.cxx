// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/TailScene.h"
#include "support/VtkScene.h"
#include "vtkSilhouetteRepairer.h"
#include "vtkVisualHullSource.h"

#include <vtkPointData.h>

using namespace novelview;
using namespace support;

namespace
{
/** The hull of some views and the repairer behind it. */
struct Stages
{
  explicit Stages(vtkMultiBlockDataSet* views)
  {
    this->Hull->SetInputData(views);
    this->Repairer->SetInputData(0, views);
    this->Repairer->SetInputConnection(1, this->Hull->GetOutputPort(1));
  }
  vtkNew<vtkVisualHullSource> Hull;
  vtkNew<vtkSilhouetteRepairer> Repairer;
};
}

TEST(SilhouetteRepairer, ChangesTheSilhouettesThatLackAPartAndNoOthers)
{
  const std::vector<Photo> photos = PhotosOfTail({ 3, 4 });
  const auto blocks = ToBlocks(photos);
  const Stages stages(blocks);
  stages.Repairer->Update();
  EXPECT_TRUE(stages.Repairer->GetRepaired());
  vtkMultiBlockDataSet* output = stages.Repairer->GetOutput();
  const std::vector<View> before = ReadViews(blocks, {});
  const std::vector<View> after = ReadViews(output, {});
  for (unsigned int i = 0; i < after.size(); ++i)
  {
    const bool changes = i == 3 || i == 4;
    EXPECT_EQ(AttachedNumber(ViewImage(output, i), arrays::AddedPixels, -1) > 0, changes) << i;
    EXPECT_EQ(after[i].Mask.Row(0) != before[i].Mask.Row(0), changes) << "shared unless changed";
    EXPECT_FALSE(ViewImage(blocks, i)->GetFieldData()->HasArray(arrays::AddedPixels));
  }
  const Vector2d tip = photos[3].Cam.Project(TailCentre);
  const int x = static_cast<int>(std::lround(tip.x()));
  const int y = static_cast<int>(std::lround(tip.y()));
  EXPECT_LT(before[3].ContourDistance(x, y), 0);
  EXPECT_GT(after[3].ContourDistance(x, y), 0);
  EXPECT_EQ(after[3].Mask(x, y), 255);
}

TEST(SilhouetteRepairer, LeavesSilhouettesThatAgreeAlone)
{
  const Stages stages(ToBlocks(PhotosOfTail({})));
  stages.Repairer->Update();
  EXPECT_FALSE(stages.Repairer->GetRepaired());
}

TEST(SilhouetteRepairer, MissingContoursAreAnError)
{
  const auto blocks = ToBlocks(PhotosOfTail({}));
  vtkNew<vtkSilhouetteRepairer> repairer;
  repairer->SetInputData(0, blocks);
  repairer->SetInputData(1, ToPolyData(SphereMesh(Vector3d::Zero(), 0.4, 2)));
  ViewImage(blocks, 2)->GetPointData()->RemoveArray(arrays::ContourDistance);
  ExpectUpdateError(repairer, "ContourDistance is missing");
}
