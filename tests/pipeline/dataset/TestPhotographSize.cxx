// SPDX-License-Identifier: GPL-3.0-or-later
#include "ViewAccess.h"
#include "dataset/PhotographSize.h"
#include "dataset/ViewSpec.h"
#include "support/CheckScene.h"

#include <vtkImageData.h>

using namespace novelview;
using namespace novelview::testing_support;
using testing::HasSubstr;

namespace
{
/** So many photographs of a size that only their calibration knows. */
DatasetIndex Declared(int count, int width, int height)
{
  DatasetIndex index;
  for (int i = 0; i < count; ++i)
  {
    Photograph& photograph = index.Cameras.emplace_back();
    photograph.Name = std::to_string(i) + ".jpg";
    photograph.Cam = support::OnRing(30.0 * i, 0);
    photograph.Cam = Resized(photograph.Cam, width, height);
  }
  return index;
}

class MaxSize : public testing::TestWithParam<const char*>
{
protected:
  DatasetIndex Read(const std::optional<double>& maxSize) const
  {
    DatasetIndex index = ReadDatasetIndex(this->Folder.Path);
    LimitSize(index, {}, maxSize);
    return index;
  }
  TemporaryFolder Folder;
};
}

TEST(ResizedCamera, SeesTheSamePlacesInTheSamePartOfTheFrame)
{
  const Camera camera = support::OnRing(20, 10);
  const Camera half = Resized(camera, camera.Width / 2, camera.Height / 2);
  const Eigen::Vector3d point(0.1, -0.2, 0.05);
  const Eigen::Vector2d full = camera.Project(point);
  EXPECT_LT((half.Project(point) - (full.array() / 2 - 0.25).matrix()).norm(), 1e-9);
}

TEST_P(MaxSize, PhotographsMasksAndCamerasAreReducedTogether)
{
  WriteDataset(this->Folder.Path, CleanPhotos(), { .Format = GetParam() });
  const DatasetIndex index = this->Read(80);
  ASSERT_EQ(index.Notes.size(), 1u);
  EXPECT_EQ(index.Notes[0].Text, "photographs of 160x120 px are reduced to 80 px at most");
  const Dataset dataset = ReadDataset(index);
  const std::vector<View> views = ReadViews(dataset.Views, { true, true, true }, 2);
  const Dataset whole = ReadDataset(this->Read(0));
  const std::vector<View> full = ReadViews(whole.Views, { true, true, true }, 2);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    ASSERT_EQ(views[i].Color.Width, 80);
    ASSERT_EQ(views[i].Mask.Height, 60);
    EXPECT_NEAR(views[i].Cam.FocalLength(), full[i].Cam.FocalLength() / 2, 1e-6);
    // The contour, half as far away in pixels, is at the same place of the object.
    const double distance = views[i].ContourDistance(40, 30);
    const double there = (full[i].ContourDistance(80, 60) + full[i].ContourDistance(81, 61)) / 2;
    EXPECT_NEAR(2 * distance, there, 1) << views[i].Name;
  }
}

TEST_P(MaxSize, NovelViewAndItsTruthHaveTheReducedSize)
{
  WriteDataset(this->Folder.Path, CleanPhotos(), { .Format = GetParam() });
  const DatasetIndex index = this->Read(80);
  const ResolvedView like = ResolveViewSpec(ParseViewSpec("like:3"), index);
  EXPECT_EQ(like.Cam.Width, 80);
  EXPECT_EQ(ReadPhotograph(like.Truth, false, {}).Color.Height, 60);
  EXPECT_EQ(ResolveViewSpec(ParseViewSpec("between:3,4"), index).Cam.Height, 60);
}

INSTANTIATE_TEST_SUITE_P(Formats, MaxSize, testing::Values("middlebury", "colmap"));

TEST(MaxSizeOfExcluded, OnlyExcludedPhotographsAreNotOpened)
{
  const TemporaryFolder folder;
  WriteDataset(folder.Path, CleanPhotos());
  std::filesystem::remove(folder / CleanPhotos()[2].Name);
  DatasetIndex index = ReadDatasetIndex(folder.Path);
  LimitSize(index, { CleanPhotos()[2].Name }, 80);
  EXPECT_EQ(index.Cameras[1].Cam.Width, 80);
  EXPECT_EQ(index.Cameras[2].FileWidth, 0);
  ExpectError([&] { LimitSize(index, {}, 80); }, CleanPhotos()[2].Name);
}

TEST(PhotographsOfTwelveCameras, OfTwentyFourMegapixelsAreReducedToFitIntoFourGiB)
{
  DatasetIndex index = Declared(12, 6000, 4000);
  LimitSize(index, {}, {});
  EXPECT_GT(index.MaxSize, 2500);
  EXPECT_LT(index.MaxSize, 3500);
  ASSERT_GE(index.Notes.size(), 1u);
  EXPECT_THAT(index.Notes[0].Text, HasSubstr("photographs of 6000x4000 px are reduced to"));
  EXPECT_THAT(index.Notes[0].Text, HasSubstr("--max-size 0 keeps their size"));
  std::vector<Camera> cameras;
  for (const Photograph& photograph : index.Cameras)
  {
    EXPECT_EQ(photograph.FileWidth, 6000);
    EXPECT_NEAR(static_cast<double>(photograph.Cam.Width) / photograph.Cam.Height, 1.5, 0.001);
    cameras.push_back(photograph.Cam);
  }
  EXPECT_LE(MemoryFor(cameras), DefaultMemory);
}

TEST(PhotographsOfTwelveCameras, OfOneMegapixelKeepTheirSize)
{
  DatasetIndex index = Declared(12, 1200, 900);
  LimitSize(index, {}, {});
  EXPECT_EQ(index.MaxSize, 0);
  EXPECT_EQ(index.Cameras[0].FileWidth, 0);
  EXPECT_EQ(index.Cameras[0].Cam.Width, 1200);
}

TEST(PhotographsOfTwelveCameras, ThatNeedMoreMemoryThanThereIsAreWarnedOf)
{
  DatasetIndex index = Declared(12, 100000, 80000);
  LimitSize(index, {}, 0);
  ASSERT_EQ(index.Notes.size(), 1u);
  EXPECT_THAT(index.Notes[0].Text, HasSubstr("GiB of memory are needed"));
  EXPECT_THAT(index.Notes[0].Text, HasSubstr("--max-size"));
}

TEST(PhotographsOfTwelveCameras, OfWhichOnlyTheLargeAreReduced)
{
  DatasetIndex index = Declared(3, 400, 300);
  index.Cameras[1].Cam = Resized(index.Cameras[1].Cam, 300, 400);
  index.Cameras[2].Cam = Resized(index.Cameras[2].Cam, 160, 120);
  LimitSize(index, {}, 200);
  EXPECT_EQ(index.Cameras[0].Cam.Width, 200);
  EXPECT_EQ(index.Cameras[1].Cam.Height, 200);
  EXPECT_EQ(index.Cameras[2].Cam.Width, 160);
  EXPECT_EQ(index.Cameras[2].FileWidth, 0);
}
