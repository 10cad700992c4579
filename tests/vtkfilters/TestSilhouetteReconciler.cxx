// SPDX-License-Identifier: GPL-3.0-or-later
#include "silhouettes/SilhouetteConsistency.h"
#include "support/VtkScene.h"
#include "vtkSilhouetteReconciler.h"

#include <vtkPointData.h>

using namespace novelview;
using namespace support;

namespace
{
/** A box; in the photograph `small` the silhouette is two pixels too small. */
std::vector<Photo> PhotosWithASmallOne(std::size_t small)
{
  std::vector<Photo> photos = BoxPhotos();
  ShrinkSilhouette(photos[small], 2);
  return photos;
}
}

TEST(SilhouetteReconciler, EnlargesTheSmallOneAndSharesTheRest)
{
  const std::vector<Photo> photos = PhotosWithASmallOne(5);
  const auto blocks = ToBlocks(photos);
  vtkNew<vtkSilhouetteReconciler> reconciler;
  reconciler->SetInputData(blocks);
  reconciler->Update();
  const auto offsets = FindContourOffsets(ViewsOf(photos));
  ASSERT_GT(offsets[5], 1);
  const std::vector<View> before = ReadViews(blocks, {});
  const std::vector<View> after = ReadViews(reconciler->GetOutput(), {});
  ASSERT_EQ(after.size(), before.size());
  for (unsigned int i = 0; i < after.size(); ++i)
  {
    EXPECT_EQ(after[i].Name, before[i].Name);
    EXPECT_EQ(
      AttachedNumber(ViewImage(reconciler->GetOutput(), i), arrays::ContourOffset, -1), offsets[i]);
    // Arrays are shared unless they had to change, and the input never does.
    EXPECT_EQ(after[i].ContourDistance.Row(0) == before[i].ContourDistance.Row(0), i != 5);
    EXPECT_EQ(after[i].Color.Row(0), before[i].Color.Row(0));
    EXPECT_EQ(before[i].ContourDistance(80, 60), photos[i].ContourDistance(80, 60));
  }
  for (int x = 0; x < 160; ++x)
  {
    const float distance = after[5].ContourDistance(x, 60);
    EXPECT_FLOAT_EQ(distance, photos[5].ContourDistance(x, 60) + static_cast<float>(offsets[5]));
    EXPECT_EQ(after[5].Mask(x, 60), distance > 0 ? 255 : 0);
  }
}

TEST(SilhouetteReconciler, OptionsDecideWhatStandsOut)
{
  const auto blocks = ToBlocks(PhotosWithASmallOne(5));
  vtkNew<vtkSilhouetteReconciler> reconciler;
  reconciler->SetInputData(blocks);
  reconciler->SetMinOffset(4);
  reconciler->Update();
  EXPECT_EQ(AttachedNumber(ViewImage(reconciler->GetOutput(), 5), arrays::ContourOffset, -1), 0);
  reconciler->SetMinOffset(0.5);
  reconciler->Update();
  EXPECT_GT(AttachedNumber(ViewImage(reconciler->GetOutput(), 5), arrays::ContourOffset, -1), 1);
  reconciler->SetMinShare(1);
  reconciler->Update();
  // Nobody stands out by as much as all rays; what is left is the slack that all get.
  EXPECT_EQ(AttachedNumber(ViewImage(reconciler->GetOutput(), 5), arrays::ContourOffset, -1),
    AttachedNumber(ViewImage(reconciler->GetOutput(), 0), arrays::ContourOffset, -1));
}

TEST(SilhouetteReconciler, MissingContoursAreAnError)
{
  const auto blocks = ToBlocks(PhotosWithASmallOne(5));
  ViewImage(blocks, 2)->GetPointData()->RemoveArray(arrays::ContourDistance);
  vtkNew<vtkSilhouetteReconciler> reconciler;
  reconciler->SetInputData(blocks);
  ExpectUpdateError(reconciler, "ContourDistance is missing");
}
