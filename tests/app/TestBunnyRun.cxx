// SPDX-License-Identifier: GPL-3.0-or-later
// The whole method on the generated bunny, by the built program.
#include "support/ProgramRun.h"

#include "images/ImageFile.h"

#include <cmath>

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;

namespace
{
/**
 * Twelve photographs of the bunny and one full run on them, made at the first need. A quarter of
 * the pixels of the real case, since a run's time goes with them.
 */
class BunnyRun : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    Bunny = std::make_unique<GeneratedData>(
      std::vector<std::string>{ "--size", "320x240", "--test-angles", "15,200" });
    MustRun(With(RunWords("run"), { "--threads", "2" }));
  }
  static void TearDownTestSuite() { Bunny.reset(); }

  static std::vector<std::string> RunWords(const std::string& out)
  {
    return { "run", Bunny->Data().string(), "--quiet", "--view", Bunny->HeldOut(), "--true-mesh",
      (Bunny->Data() / "truth.ply").string(), "--no-screenshots", "--out",
      (Bunny->Folder / out).string() };
  }
  static fs::path Out(const std::string& out) { return Bunny->Folder / out; }

  static inline std::unique_ptr<GeneratedData> Bunny;
};

void ExpectPicture(const fs::path& path, int width, int height)
{
  const Image<std::uint8_t> picture = ReadColorFile(path);
  EXPECT_EQ(SizeText(picture.Width, picture.Height), SizeText(width, height)) << path;
}
}

TEST_F(BunnyRun, EveryStageIsBetterThanTheOneBefore)
{
  const double hull = ScoreIn(Out("run"), "hull", "rms");
  const double outline = ScoreIn(Out("run"), "outline", "rms");
  const double full = ScoreIn(Out("run"), "full", "rms");
  EXPECT_LT(outline, hull);
  EXPECT_LT(full, outline);
  // What the project promises for 640x480; at half the size the same geometry is missing.
  EXPECT_LE(full, 0.8 * hull);
  EXPECT_GE(ScoreIn(Out("run"), "full", "ssim"), 0.85);
  EXPECT_LT(ScoreIn(Out("run"), "outline", "excess"), ScoreIn(Out("run"), "hull", "excess"))
    << "the outline deformer cuts off what the hull has too much";
}

TEST_F(BunnyRun, GapToTheTrueMeshIsTold)
{
  const nlohmann::json summary = ReadJson(Out("run") / "summary.json");
  const double hull = ScoreIn(Out("run"), "hull", "rms");
  const double full = ScoreIn(Out("run"), "full", "rms");
  const double oracle = ScoreIn(Out("run"), "oracle", "rms");
  EXPECT_LT(oracle, full) << "no geometry beats the true one";
  const double closed = summary.at("gap_closure").at("rms").get<double>();
  EXPECT_NEAR(closed, (hull - full) / (hull - oracle), 1e-12);
  // Measured 0.74: half the gap is what a broken refinement does not reach.
  EXPECT_GT(closed, 0.5);
}

TEST_F(BunnyRun, WhatWasEstimatedFromThePhotographsIsTold)
{
  const nlohmann::json estimates = ReadJson(Out("run") / "summary.json").at("estimates");
  const double noise = estimates.at("depth_noise").get<double>();
  EXPECT_GT(noise, 0.05);
  EXPECT_LT(noise, 1) << "photographs and cameras are exact";
  EXPECT_GT(estimates.at("silhouette_prior").get<double>(), 0);
  EXPECT_GE(estimates.at("exposure_gains").size(), 6u);
  EXPECT_EQ(estimates.at("exposure_gains").at(0).get<double>(), 1) << "all have one exposure";
}

TEST_F(BunnyRun, WritesWhatIsDocumented)
{
  const fs::path out = Out("run");
  for (const char* name :
    { "novel.png", "novel_mask.png", "novel_unseen.png", "truth.png", "stages/hull.png",
      "stages/outline.png", "stages/full.png", "stages/oracle.png", "stages/hull_mask.png",
      "stages/full_error.png", "iterations/outline_00.png", "iterations/nonoutline_00.png" })
  {
    ExpectPicture(out / name, 320, 240);
  }
  const Image<float> depth = ReadFloatFile(out / "novel_depth.tiff");
  EXPECT_EQ(SizeText(depth.Width, depth.Height), "320x240");
  EXPECT_GT(ReadPictureSize(out / "rms.png").Width, 0);
  for (const char* name :
    { "visual_hull", "power_crust", "medial_balls", "hull", "outline", "full" })
  {
    // Appended data are what not every ParaView can read.
    EXPECT_THAT(ReadText(out / "meshes" / (std::string(name) + ".vtp")),
      testing::AllOf(testing::HasSubstr("type=\"PolyData\""),
        testing::Not(testing::HasSubstr("<AppendedData"))));
  }
  // Samples without a cell each are there, but not shown.
  EXPECT_THAT(ReadText(out / "meshes/visual_hull.vtp"),
    testing::Not(testing::HasSubstr("NumberOfVerts=\"0\"")));
  EXPECT_TRUE(HalfWritten(out).empty());
  EXPECT_TRUE(ReadText(out / "novel.png") == ReadText(out / "stages/full.png"));
  EXPECT_EQ(ReadJson(out / "job.json").at("preset"), "best");
}

TEST_F(BunnyRun, TablesTellEveryIteration)
{
  for (const char* step : { "outline", "nonoutline" })
  {
    const auto table = ReadTable(Out("run") / ("rms_" + std::string(step) + ".csv"));
    for (const char* column : { "iteration", "rms", "psnr", "ssim", "iou", "mean_energy",
           "mean_photo", "mean_smooth", "points_moved" })
    {
      ASSERT_TRUE(table.contains(column)) << column;
      for (const double value : table.at(column))
      {
        EXPECT_TRUE(std::isfinite(value)) << column;
      }
    }
    EXPECT_TRUE(table.contains(step[0] == 'o' ? "mean_contour" : "mean_hull"));
    const std::size_t rows = table.at("iteration").size();
    ASSERT_GE(rows, 2u);
    for (std::size_t i = 0; i < rows; ++i)
    {
      EXPECT_EQ(table.at("iteration")[i], i);
    }
    EXPECT_EQ(table.at("points_moved")[0], 0) << "line 0 is the state before the first move";
    EXPECT_LT(table.at("rms").back(), table.at("rms").front());
  }
  const auto outline = ReadTable(Out("run") / "rms_outline.csv");
  const auto nonOutline = ReadTable(Out("run") / "rms_nonoutline.csv");
  EXPECT_EQ(outline.at("rms").front(), ScoreIn(Out("run"), "hull", "rms"));
  EXPECT_EQ(outline.at("rms").back(), ScoreIn(Out("run"), "outline", "rms"));
  EXPECT_EQ(nonOutline.at("rms").front(), ScoreIn(Out("run"), "outline", "rms"));
  EXPECT_EQ(nonOutline.at("rms").back(), ScoreIn(Out("run"), "full", "rms"));
}

TEST_F(BunnyRun, SeriesNamesAMeshForEveryLineOfTheTables)
{
  const std::string series = ReadText(Out("run") / "meshes/iterations.pvd");
  const std::string before = "file=\"";
  std::size_t entries = 0;
  for (std::size_t at = series.find(before); at != std::string::npos; at = series.find(before, at))
  {
    at += before.size();
    const std::string file = series.substr(at, series.find('"', at) - at);
    EXPECT_TRUE(fs::is_regular_file(Out("run") / "meshes" / file)) << file;
    ++entries;
  }
  EXPECT_EQ(entries,
    ReadTable(Out("run") / "rms_outline.csv").at("rms").size() +
      ReadTable(Out("run") / "rms_nonoutline.csv").at("rms").size());
}

TEST_F(BunnyRun, AnotherNumberOfThreadsGivesTheSameFiles)
{
  MustRun(With(RunWords("one"), { "--threads", "1" }));
  ExpectSameFiles(Out("run"), Out("one"));
}

TEST_F(BunnyRun, WrittenJobGivesTheSameFiles)
{
  fs::create_directory(Out("again"));
  fs::copy_file(Out("run") / "job.json", Out("again") / "job.json");
  MustRun({ "run", (Out("again") / "job.json").string(), "--quiet" });
  ExpectSameFiles(Out("run"), Out("again"));
}

TEST_F(BunnyRun, RenderGivesTheSamePictures)
{
  const fs::path cameras = Bunny->Data() / "test" / "test_par.txt";
  MustRun({ "render", Bunny->Data().string(), "--quiet", "--cameras", cameras.string(), "--out",
    Out("render").string() });
  EXPECT_TRUE(ReadText(Out("render") / "test0000.png") == ReadText(Out("run") / "novel.png"));
  EXPECT_TRUE(
    ReadText(Out("render") / "mask" / "test0000.png") == ReadText(Out("run") / "novel_mask.png"));
  ExpectPicture(Out("render") / "test0001.png", 320, 240);
  ExpectPicture(Out("render") / "mask" / "test0001.png", 320, 240);
  EXPECT_EQ(FilesBelow(Out("render")).size(), 4u);
}

TEST_F(BunnyRun, TheTablesShowEveryIterationLoweringTheEnergy)
{
  for (const char* step : { "outline", "nonoutline" })
  {
    const auto table = ReadTable(Out("run") / ("rms_" + std::string(step) + ".csv"));
    const std::vector<double>& energies = table.at("mean_energy");
    ASSERT_GT(energies.size(), 4u) << step;
    for (std::size_t i = 1; i < energies.size(); ++i)
    {
      EXPECT_LT(energies[i], energies[i - 1]) << step << ", iteration " << i;
    }
    EXPECT_LT(table.at("rms").back(), table.at("rms").front()) << step;
  }
}

TEST_F(BunnyRun, PaperPresetRefinesTheHull)
{
  MustRun(With(RunWords("paper"), { "--preset", "paper" }));
  EXPECT_LT(ScoreIn(Out("paper"), "full", "rms"), ScoreIn(Out("paper"), "hull", "rms"));
  EXPECT_GT(ScoreIn(Out("paper"), "full", "ssim"), ScoreIn(Out("paper"), "hull", "ssim"));
  for (const char* step : { "outline", "nonoutline" })
  {
    const auto table = ReadTable(Out("paper") / ("rms_" + std::string(step) + ".csv"));
    ASSERT_GE(table.at("mean_energy").size(), 2u);
    EXPECT_LT(table.at("mean_energy").back(), table.at("mean_energy").front()) << step;
    EXPECT_GT(table.at("points_moved")[1], 0) << step;
  }
}

TEST(BunnyFullSize, HoldsThePromisedBounds)
{
  const GeneratedData bunny({});
  const fs::path out = bunny.Folder / "run";
  MustRun({ "run", bunny.Data().string(), "--quiet", "--view", bunny.HeldOut(), "--no-iterations",
    "--out", out.string() });
  // The project's own bounds for twelve views of 640x480 and a novel view half-way between two.
  EXPECT_LT(ScoreIn(out, "outline", "rms"), ScoreIn(out, "hull", "rms"));
  EXPECT_LE(ScoreIn(out, "full", "rms"), 0.8 * ScoreIn(out, "hull", "rms"));
  EXPECT_GE(ScoreIn(out, "full", "ssim"), 0.85);
}

TEST(BunnyScreenshots, AreTheSameInEveryRun)
{
  const GeneratedData bunny({ "--views", "8", "--step", "45", "--size", "160x120" });
  for (const char* out : { "a", "b" })
  {
    MustRun({ "run", bunny.Data().string(), "--quiet", "--view", bunny.HeldOut(),
      "--outline-iterations", "1", "--non-outline-iterations", "1", "--out",
      (bunny.Folder / out).string(), "--threads", out[0] == 'a' ? "1" : "2" });
  }
  ExpectSameFiles(bunny.Folder / "a", bunny.Folder / "b");
  for (const char* name : { "outline_00", "outline_01", "nonoutline_00", "nonoutline_01" })
  {
    const fs::path picture = bunny.Folder / "a/iterations" / (std::string(name) + "_desktop.png");
    EXPECT_GE(ReadPictureSize(picture).Width, 640) << "a desktop's width";
  }
}
