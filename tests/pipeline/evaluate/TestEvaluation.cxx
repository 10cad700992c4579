// SPDX-License-Identifier: GPL-3.0-or-later
#include "ViewAccess.h"
#include "commands/EvaluateOptions.h"
#include "evaluate/EvaluationPictures.h"
#include "evaluate/EvaluationPlan.h"
#include "evaluate/EvaluationScores.h"
#include "formats/DatasetFormats.h"
#include "formats/Middlebury.h"
#include "images/ImageFile.h"
#include "support/TestSupport.h"

#include <nlohmann/json.hpp>

using namespace novelview;
using namespace novelview::testing_support;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace
{
/** Scores of whole numbers and halves, so that means of two are exact. */
Scores Made(double rms, double ssim)
{
  return { rms, 20, ssim, 0.5, 0.25, 0.125 };
}

std::vector<EvaluatedView> TwoViews()
{
  return { { "a.png", 7,
             { { "hull", Made(10, 0.5) }, { "outline", Made(9, 0.5) }, { "full", Made(4, 0.75) },
               { "oracle", Made(2, 0.75) } } },
    { "b,c.png", 7,
      { { "hull", Made(14, 0.25) }, { "outline", Made(13, 0.25) }, { "full", Made(16, 0.5) },
        { "oracle", Made(6, 1) } } } };
}

/** Six cameras on a ring with photographs of 32x24; `tests` cameras more in test/. */
DatasetIndex MakeDataset(const TemporaryFolder& folder, int tests = 0)
{
  const auto make = [](const std::filesystem::path& where, const std::string& stem, int count)
  {
    std::vector<NamedCamera> cameras;
    for (int i = 0; i < count; ++i)
    {
      const double a = i * EIGEN_PI / 3;
      Eigen::Matrix3d k;
      k << 100, 0, 15.5, 0, 100, 11.5, 0, 0, 1;
      cameras.push_back({ stem + std::to_string(i) + ".png",
        LookAt({ 3 * std::sin(a), 0, 3 * std::cos(a) }, { 0, 0, 0 }, Eigen::Vector3d::UnitY(), k,
          32, 24) });
      WriteImageFile(where / cameras.back().Name, Image<std::uint8_t>(32, 24, 3).Ref());
    }
    WriteCameras(where / (stem + "_par.txt"), cameras);
  };
  make(folder.Path, "c", 6);
  if (tests > 0)
  {
    make(folder / "test", "t", tests);
  }
  return ReadDatasetIndex(folder.Path);
}

std::vector<std::string> NamesOf(const PlannedSet& set)
{
  std::vector<std::string> names;
  for (const PlannedView& view : set.Views)
  {
    names.push_back(view.Name);
  }
  return names;
}

vtkSmartPointer<vtkImageData> Grey(unsigned char value)
{
  vtkSmartPointer<vtkImageData> image = NewImage(80, 60);
  const auto color = AddTopDownArray<unsigned char>(image, arrays::Color, 3);
  const auto mask = AddTopDownArray<unsigned char>(image, arrays::Mask, 1);
  for (int y = 0; y < 60; ++y)
  {
    std::fill_n(color.Row(y), 3 * 80, value);
    std::fill_n(mask.Row(y), 80, std::uint8_t{ 255 });
  }
  return image;
}

/** Share of a picture's pixels whose channels are all within 2 of these. */
double ShareOf(const Image<std::uint8_t>& picture, int red, int green, int blue)
{
  long count = 0;
  for (int y = 0; y < picture.Height; ++y)
  {
    for (int x = 0; x < picture.Width; ++x)
    {
      count += std::abs(picture(x, y, 0) - red) <= 2 && std::abs(picture(x, y, 1) - green) <= 2 &&
        std::abs(picture(x, y, 2) - blue) <= 2;
    }
  }
  return static_cast<double>(count) / (static_cast<double>(picture.Width) * picture.Height);
}
}

TEST(EvaluationScores, MeansAreOverTheViewsByStage)
{
  const ScoresByStage means = MeanScores(TwoViews());
  ASSERT_EQ(means.size(), 4u);
  EXPECT_EQ(means[0].first, "hull");
  EXPECT_EQ(means[0].second.Rms, 12);
  EXPECT_EQ(means[0].second.Ssim, 0.375);
  EXPECT_EQ(means[0].second.Psnr, 20);
  EXPECT_EQ(means[3].first, "oracle");
  EXPECT_EQ(means[3].second.Rms, 4);
  EXPECT_EQ(means[3].second.Excess, 0.125);
  EXPECT_THAT(MeanScores({}), IsEmpty());
}

TEST(EvaluationScores, ClosureIsThatOfTheMeans)
{
  // RMS 12 -> 10 of 12 -> 4; SSIM 0.375 -> 0.625 of 0.375 -> 0.875. All are exact in binary.
  const auto closure = ClosureOf(MeanScores(TwoViews()));
  ASSERT_TRUE(closure);
  EXPECT_EQ(closure->Rms, 0.25);
  EXPECT_EQ(closure->Ssim, 0.5);
  std::vector<EvaluatedView> views = TwoViews();
  for (EvaluatedView& view : views)
  {
    view.Stages.pop_back();
  }
  EXPECT_FALSE(ClosureOf(MeanScores(views))) << "there is no oracle";
  EXPECT_FALSE(EvaluationJson(views).contains("gap_closure"));
}

TEST(EvaluationScores, ViewsWorseThanTheirHullAreNamed)
{
  EXPECT_THAT(WorseThanHull(TwoViews()), ElementsAre("b,c.png"));
  EXPECT_EQ(
    EvaluationJson(TwoViews())["worse_than_hull"], nlohmann::ordered_json::array({ "b,c.png" }));
}

TEST(EvaluationScores, CsvHoldsEveryNumberAndQuotesNamesWithCommas)
{
  const std::string csv = ScoresCsv(TwoViews());
  EXPECT_THAT(csv,
    testing::StartsWith("view,stage,rms,psnr,ssim,iou,missing,excess\n"
                        "a.png,hull,10.0,20.0,0.5,0.5,0.25,0.125\na.png,outline,"));
  EXPECT_THAT(csv, HasSubstr("\n\"b,c.png\",full,16.0,"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 4);
}

TEST(EvaluationScores, TableIsAligned)
{
  const std::vector<std::string> lines = ScoreTable(TwoViews());
  // A head, two views and the means of four stages each, the gap.
  ASSERT_EQ(lines.size(), 1u + 3 * 4 + 1);
  for (std::size_t i = 1; i + 1 < lines.size(); ++i)
  {
    EXPECT_EQ(lines[i].size(), lines[0].size()) << lines[i];
  }
  EXPECT_THAT(lines[3], testing::StartsWith("a.png      full         4.00"));
  EXPECT_THAT(lines[9], testing::StartsWith("mean of 2  hull        12.00"));
  EXPECT_THAT(lines.back(), HasSubstr("RMS 0.250, SSIM 0.500"));
}

TEST(EvaluationPlan, TestViewsAreTheDefault)
{
  const TemporaryFolder folder;
  EvaluateOptions options;
  const DatasetIndex dataset = MakeDataset(folder, 3);
  EvaluationPlan plan = MakeEvaluationPlan(options, dataset);
  ASSERT_EQ(plan.Sets.size(), 1u);
  EXPECT_THAT(NamesOf(plan.Sets[0]), ElementsAre("t0.png", "t1.png", "t2.png"));
  EXPECT_THAT(plan.Sets[0].HeldOut, IsEmpty());
  EXPECT_EQ(plan.Sets[0].References, 6u);
  EXPECT_EQ(plan.Sets[0].Views[1].View.Truth.File, folder / "test/t1.png");
  EXPECT_TRUE(plan.TrueMesh.empty());
  WriteText(folder / "truth.ply", "");
  EXPECT_EQ(MakeEvaluationPlan(options, dataset).TrueMesh, folder / "truth.ply");
  // A test view without its photograph cannot be scored.
  std::filesystem::remove(folder / "test/t1.png");
  plan = MakeEvaluationPlan(options, dataset);
  EXPECT_THAT(NamesOf(plan.Sets[0]), ElementsAre("t0.png", "t2.png"));
  ASSERT_EQ(plan.Warnings.size(), 1u);
  EXPECT_THAT(plan.Warnings[0], HasSubstr("t1.png"));
}

TEST(EvaluationPlan, TestSplitOfNerfIsPredictedAndHeldOut)
{
  const TemporaryFolder folder;
  const DatasetIndex made = MakeDataset(folder);
  const auto write = [&](const std::string& name, std::size_t from, std::size_t to)
  {
    nlohmann::json whole{ { "fl_x", 100 }, { "cx", 16 }, { "cy", 12 }, { "w", 32 }, { "h", 24 } };
    for (std::size_t i = from; i < to; ++i)
    {
      const Camera& camera = made.Cameras[i].Cam;
      Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
      pose.topLeftCorner<3, 3>() = camera.R.transpose() * Eigen::Vector3d(1, -1, -1).asDiagonal();
      pose.topRightCorner<3, 1>() = camera.Centre();
      nlohmann::json rows;
      for (int row = 0; row < 4; ++row)
      {
        rows.push_back({ pose(row, 0), pose(row, 1), pose(row, 2), pose(row, 3) });
      }
      whole["frames"].push_back(
        { { "file_path", made.Cameras[i].Name }, { "transform_matrix", rows } });
    }
    WriteText(folder / name, whole.dump());
  };
  std::filesystem::remove(folder / "c_par.txt");
  write("transforms_train.json", 0, 4);
  write("transforms_val.json", 5, 6);
  const auto views = [&]
  {
    const EvaluationPlan plan = MakeEvaluationPlan({}, ReadDatasetIndex(folder.Path));
    EXPECT_EQ(plan.Mode, "test views");
    EXPECT_EQ(plan.Sets.at(0).References, 4u - plan.Sets.at(0).HeldOut.size());
    std::vector<std::string> names;
    for (const PlannedView& view : plan.Sets.at(0).Views)
    {
      names.push_back(view.Name);
    }
    return names;
  };
  EXPECT_THAT(views(), ElementsAre("c5.png"));
  write("transforms_test.json", 3, 5);
  EXPECT_THAT(views(), ElementsAre("c3.png", "c4.png"));
  EXPECT_THAT(
    MakeEvaluationPlan({}, ReadDatasetIndex(folder.Path)).Sets[0].HeldOut, ElementsAre("c3.png"));
}

TEST(EvaluationPlan, TestSplitIsReadWithTheConventionGivenForTheDataSet)
{
  const TemporaryFolder folder;
  const DatasetIndex made = MakeDataset(folder, 1);
  // World-to-camera matrices are in the file; a program that wrote the opposite says so.
  const auto write = [&](const std::string& name, std::size_t from, std::size_t to)
  {
    std::vector<Photograph> photographs;
    for (std::size_t i = from; i < to; ++i)
    {
      Photograph& turned = photographs.emplace_back(made.Cameras[i]);
      turned.Cam.R = made.Cameras[i].Cam.R.transpose();
      turned.Cam.T = made.Cameras[i].Cam.Centre();
      WriteImageFile(
        (folder / name).parent_path() / turned.Name, Image<std::uint8_t>(32, 24, 3).Ref());
    }
    for (const FileContent& file : FormatOf("middlebury").Compose("c", photographs))
    {
      WriteText(folder / name, file.Bytes);
    }
  };
  write("c_par.txt", 0, 4);
  write("test/t_par.txt", 4, 5); // in place of the one of MakeDataset()
  DatasetSource source;
  source.Convention.Poses = "camera-to-world";
  const DatasetIndex index = ReadDatasetIndex(folder.Path, source);
  const EvaluationPlan plan = MakeEvaluationPlan({}, index);
  ASSERT_EQ(plan.Sets.at(0).Views.size(), 1u);
  const Camera& camera = plan.Sets[0].Views[0].View.Cam;
  EXPECT_LT((camera.Centre() - made.Cameras[4].Cam.Centre()).norm(), 1e-6);
}

TEST(EvaluationPlan, TestViewThatIsAReferenceIsHeldOut)
{
  const TemporaryFolder folder;
  const DatasetIndex dataset = MakeDataset(folder, 1);
  std::filesystem::remove(folder / "test/t0.png");
  std::filesystem::create_symlink(folder / "c4.png", folder / "test/t0.png");
  const EvaluationPlan plan = MakeEvaluationPlan({}, dataset);
  EXPECT_THAT(plan.Sets.at(0).HeldOut, ElementsAre("c4.png"));
  EXPECT_EQ(plan.Sets[0].References, 5u);
}

TEST(EvaluationPlan, WithoutTestViewsEachPhotographIsPredictedFromTheOthers)
{
  const TemporaryFolder folder;
  const DatasetIndex dataset = MakeDataset(folder);
  WriteText(folder / "truth.ply", "");
  const EvaluationPlan plan = MakeEvaluationPlan({}, dataset, { "c1.png" });
  ASSERT_EQ(plan.Sets.size(), 5u);
  EXPECT_THAT(NamesOf(plan.Sets[1]), ElementsAre("c2.png"));
  EXPECT_THAT(plan.Sets[1].HeldOut, ElementsAre("c2.png"));
  EXPECT_EQ(plan.Sets[1].References, 4u);
  EXPECT_TRUE(plan.TrueMesh.empty()) << "only with test views it is taken unasked";
}

TEST(EvaluationPlan, EveryKthOfThosePhotographsThatAreNotExcluded)
{
  const TemporaryFolder folder;
  EvaluateOptions options;
  options.Every = 2;
  const EvaluationPlan plan = MakeEvaluationPlan(options, MakeDataset(folder, 3), { "c1.png" });
  ASSERT_EQ(plan.Sets.size(), 1u);
  EXPECT_THAT(NamesOf(plan.Sets[0]), ElementsAre("c0.png", "c3.png", "c5.png"));
  EXPECT_THAT(plan.Sets[0].HeldOut, ElementsAre("c0.png", "c3.png", "c5.png"));
  EXPECT_EQ(plan.Sets[0].References, 2u);
}

TEST(EvaluationPlan, WhatCannotBeIsNamed)
{
  const TemporaryFolder folder;
  const DatasetIndex dataset = MakeDataset(folder);
  EvaluateOptions options;
  options.HoldOut = { "c0.png", "c9.png" };
  ExpectError([&] { MakeEvaluationPlan(options, dataset); }, "--hold-out",
    "c_par.txt has no photograph of this name", "'c9.png'", "like c0.png");
  options.HoldOut = { "c0.png", "c1.png", "c2.png", "c3.png", "c4.png", "c5.png" };
  ExpectError([&] { MakeEvaluationPlan(options, dataset); }, "no photograph left");
}

TEST(EvaluateOptions, ContradictionsAreUsageErrors)
{
  const auto expect = [](const ParsedArguments& more, const auto&... parts)
  {
    ParsedArguments given{ { "out", { "o" } } };
    given.insert(given.end(), more.begin(), more.end());
    EXPECT_THROW(MakeEvaluateOptions("d", given), UsageError);
    ExpectError([&] { MakeEvaluateOptions("d", given); }, parts...);
  };
  expect({ { "holdOut", { "a" } }, { "leaveOneOut", { "true" } } }, "--leave-one-out",
    "cannot be given with --hold-out");
  expect({ { "every", { "3" } }, { "leaveOneOut", { "true" } } }, "--leave-one-out",
    "cannot be given with --every");
  expect({ { "every", { "1" } } }, "--every", "leaves no photograph", "at least 2");
  expect({ { "every", { "-1" } } }, "--every", "out of range");
  expect({ { "holdOut", { "a", "a" } } }, "--hold-out", "twice: a");
  expect({ { "holdOut", { "a" } }, { "exclude", { "a" } } }, "--hold-out", "--exclude");
  EXPECT_THROW(MakeEvaluateOptions("d", {}), UsageError) << "no folder";
}

TEST(EvaluationPictures, OverviewShowsEveryRowAndTheError)
{
  const TemporaryFolder folder;
  const auto truth = Grey(140);
  const auto hull = Grey(100);
  const auto last = Grey(180);
  Overview overview("torus", "full", 2, 80.0 / 60);
  overview.AddRow({ "a.png", truth, hull, last, 40, 40 });
  overview.AddRow({ "b.png", truth, hull, hull, 40, 40 });
  overview.Write(folder / "overview.png");
  const Image<std::uint8_t> picture = ReadColorFile(folder / "overview.png");
  // Eight pictures of equal size; titles, names and gaps take about a third of the sheet.
  const double cell = ShareOf(picture, 180, 180, 180);
  EXPECT_GT(cell, 0.06);
  EXPECT_NEAR(ShareOf(picture, 140, 140, 140), 2 * cell, 0.005);
  EXPECT_NEAR(ShareOf(picture, 100, 100, 100), 3 * cell, 0.005);
  // The error of 40 is the middle of the scale to 80: 0.73, 0.21, 0.33; the bar has it, too.
  EXPECT_NEAR(ShareOf(picture, 186, 54, 84), 2 * cell, 0.01);
}

TEST(EvaluationPictures, ManyViewsFitOnASheet)
{
  const TemporaryFolder folder;
  const auto truth = Grey(140);
  Overview overview("torus", "hull", 100, 80.0 / 60);
  for (int i = 0; i < 100; ++i)
  {
    overview.AddRow({ "view", truth, truth, truth, 0, 0 });
  }
  overview.Write(folder / "overview.png");
  // 8000 is what the sheet is kept below.
  EXPECT_LE(ReadPictureSize(folder / "overview.png").Height, 8000);
}

TEST(EvaluationPictures, ChartHasALinePerStage)
{
  const TemporaryFolder folder;
  DrawEvaluationChart("torus", TwoViews(), folder / "chart.png");
  const Image<std::uint8_t> picture = ReadColorFile(folder / "chart.png");
  EXPECT_EQ(SizeText(picture.Width, picture.Height), "1600x700");
  const double pixels = 100.0 / (1600 * 700); // a line is many hundreds of pixels long
  EXPECT_GT(ShareOf(picture, 255, 115, 51), pixels) << "outline";
  EXPECT_GT(ShareOf(picture, 89, 184, 242), pixels) << "full";
  EXPECT_GT(ShareOf(picture, 77, 166, 89), pixels) << "oracle";
}
