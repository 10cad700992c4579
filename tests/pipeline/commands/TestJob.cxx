// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/AtomicFile.h"
#include "base/JsonFile.h"
#include "commands/ConvertOptions.h"
#include "commands/EvaluateOptions.h"
#include "commands/RenderOptions.h"
#include "commands/RunOptions.h"
#include "formats/Middlebury.h"
#include "generator/Generator.h"
#include "images/ImageFile.h"
#include "options/NearestWord.h"
#include "support/TestSupport.h"

#include <set>

using namespace novelview;
using namespace novelview::testing_support;

namespace
{
/** A data set of four cameras 30 degrees apart; only the first two photographs exist as files. */
DatasetIndex MakeDataset(const TemporaryFolder& folder)
{
  std::vector<NamedCamera> cameras;
  for (int i = 0; i < 4; ++i)
  {
    const double a = i * EIGEN_PI / 6;
    Eigen::Matrix3d k;
    k << 100, 0, 15.5, 0, 100, 11.5, 0, 0, 1;
    cameras.push_back({ "c" + std::to_string(i) + ".png",
      LookAt({ 3 * std::sin(a), 0, 3 * std::cos(a) }, { 0, 0, 0 }, Eigen::Vector3d::UnitY(), k, 32,
        24) });
  }
  WriteCameras(folder / "c_par.txt", cameras);
  WriteImageFile(folder / "c0.png", Image<std::uint8_t>(32, 24, 3).Ref());
  WriteImageFile(folder / "c1.png", Image<std::uint8_t>(40, 30, 3).Ref());
  return ReadDatasetIndex(folder.Path);
}

ParsedArguments Minimal()
{
  return { { "view", { "between:0,1" } }, { "out", { "out" } } };
}

/** Minimal(), and one option more. */
ParsedArguments With(const std::string& key, const std::vector<std::string>& words)
{
  ParsedArguments given = Minimal();
  given.emplace_back(key, words);
  return given;
}
}

TEST(Options, KeysAndFlagsAreUniqueAndExplained)
{
  RunOptions job;
  RenderOptions render;
  EvaluateOptions evaluate;
  GeneratorOptions generator;
  ConvertOptions convert;
  for (const OptionTable& table : { OptionsOf(job), OptionsOf(render), OptionsOf(evaluate),
         OptionsOf(generator), OptionsOf(convert) })
  {
    std::set<std::string> flags;
    for (const Option& option : table)
    {
      EXPECT_TRUE(flags.insert(FlagOf(option.Key)).second) << option.Key;
      for (const std::string& former : option.FormerKeys)
      {
        EXPECT_TRUE(flags.insert(FlagOf(former)).second) << former;
      }
      EXPECT_FALSE(option.Help.empty()) << option.Key;
      EXPECT_FALSE(option.Group.empty()) << option.Key;
      EXPECT_LE(option.Min, option.Max) << option.Key;
    }
  }
  EXPECT_EQ(FlagOf("hullSpacing"), "--hull-spacing");
}

TEST(Options, NearestWordIsTheOneWithTheFewestEdits)
{
  const std::vector<std::string> known{ "hullSpacing", "hullBox", "power" };
  EXPECT_EQ(NearestWord("hullspacing", known), "hullSpacing");
  EXPECT_EQ(NearestWord("hulSpaccing", known), "hullSpacing");
  EXPECT_EQ(NearestWord("pover", known), "power");
  EXPECT_EQ(NearestWord("completely", known), "");
}

TEST(Job, CommandLineSetsEveryKindOfOption)
{
  ParsedArguments given = Minimal();
  given.insert(given.end(),
    { { "hullSpacing", { "1.25" } }, { "hullBox", { "-1", "-2", "-3", "1", "2", "3.5" } },
      { "hullKeepAll", { "true" } }, { "exclude", { "a.png", "b.png" } },
      { "stage", { "outline" } }, { "silhouetteLevel", { "40" } }, { "references", { "5" } },
      { "truth", { "t.png" } } });
  const RunOptions job = MakeRunOptions("bunny", given);
  EXPECT_EQ(job.Input.Dataset, "bunny");
  EXPECT_EQ(job.Out, "out");
  EXPECT_EQ(job.View.From, "0");
  EXPECT_EQ(job.Synthesis.Hull.SpacingPx, 1.25);
  EXPECT_EQ(job.Synthesis.Hull.Box, (std::array<double, 6>{ -1, -2, -3, 1, 2, 3.5 }));
  EXPECT_TRUE(job.Synthesis.Hull.KeepAllComponents);
  EXPECT_EQ(job.Input.Exclude, (std::vector<std::string>{ "a.png", "b.png" }));
  EXPECT_EQ(job.UpTo, Stage::Outline);
  EXPECT_EQ(job.Input.Silhouette.Level, 40);
  EXPECT_EQ(job.Synthesis.Texture.References, 5);
  EXPECT_EQ(job.Truth, "t.png");
}

TEST(Job, BadValuesOnTheCommandLineAreNamed)
{
  const auto expect =
    [](const std::string& key, const std::vector<std::string>& words, const auto&... parts)
  { ExpectError([&] { MakeRunOptions("bunny", With(key, words)); }, parts...); };
  expect("hullSpacing", { "two" }, "--hull-spacing", "is not a number", "'two'");
  expect("hullSpacing", { "0" }, "--hull-spacing", "out of range", "got 0", "0.25 to 64");
  expect("hullSpacing", { "nan" }, "--hull-spacing", "out of range");
  expect("references", { "2.5" }, "--references", "not a whole number", "'2.5'");
  expect("hullBox", { "1", "2" }, "--hull-box", "got 2 numbers, expected 6");
  expect(
    "hullBox", { "1", "0", "0", "0", "1", "1" }, "--hull-box", "is not a box", "got 1,0,0,0,1,1");
  expect("hullKeepAll", { "yes" }, "--hull-keep-all", "true or false");
  expect("stage", { "mesh" }, "--stage", "'mesh'", "hull, outline, full");
  expect("preset", { "bst" }, "--preset", "'bst'", "best, paper");
  expect("view", { "between:0" }, "view", "needs two cameras", "between:A,B[,FRACTION]");
}

TEST(Job, WhatIsMissingIsNamed)
{
  const auto make = [](const ParsedArguments& given)
  { return [given] { MakeRunOptions("bunny", given); }; };
  ExpectError(make({ { "out", { "o" } } }), "--view", "no novel view");
  ExpectError(make({ { "view", { "like:a.png" } } }), "--out");
  ExpectError(make(With("truthMask", { "m.png" })), "--truth-mask", "without --truth");
  ExpectError([] { MakeRenderOptions("bunny", { { "out", { "o" } } }); }, "--cameras");
  EXPECT_THROW(MakeRunOptions("bunny", {}), UsageError);
}

TEST(Job, FileGoesOverPresetAndCommandLineOverFile)
{
  const TemporaryFolder folder;
  WriteText(folder / "job.json", R"({"dataset": "photos", "view": "file:test/t_par.txt#a.png",
    "out": "results", "preset": "paper", "hullSpacing": 3, "power": 2, "silhouetteLevel": null,
    "hullBox": [0, 0, 0, 1, 1, 1], "threads": 2, "exclude": ["x.png"], "iterations": false})");
  const RunOptions job = MakeRunOptions(folder / "job.json", { { "power", { "4" } } });
  // Relative paths are relative to the file's folder, in the view, too.
  EXPECT_EQ(job.Input.Dataset, folder / "photos");
  EXPECT_EQ(job.Out, folder / "results");
  EXPECT_EQ(job.View.ParFile, folder / "test/t_par.txt");
  EXPECT_EQ(job.View.Name, "a.png");
  EXPECT_EQ(job.Synthesis.Preset, "paper");
  EXPECT_EQ(job.Synthesis.Hull.SpacingPx, 3);
  EXPECT_EQ(job.Synthesis.Texture.Power, 4);
  EXPECT_EQ(job.Synthesis.Outline.Iterations, PresetOptions("paper").Outline.Iterations);
  EXPECT_EQ(job.Threads, 2);
  EXPECT_FALSE(job.WriteIterations);
  // A preset on the command line replaces the file's stage options, but not those beside it.
  const RunOptions best =
    MakeRunOptions(folder / "job.json", { { "power", { "4" } }, { "preset", { "best" } } });
  EXPECT_EQ(best.Synthesis.Preset, "best");
  EXPECT_EQ(best.Synthesis.Hull.SpacingPx, PresetOptions("best").Hull.SpacingPx);
  EXPECT_EQ(best.Synthesis.Texture.Power, 4);
  EXPECT_EQ(best.Input.Exclude, std::vector<std::string>{ "x.png" });
}

TEST(Job, WrittenJobIsCompleteAndReadsBackTheSame)
{
  const TemporaryFolder folder;
  ParsedArguments given = With("hullSpacing", { "0.3" });
  given.emplace_back("hullBox", std::vector<std::string>{ "0.1", "0", "0", "1", "1", "1" });
  given.emplace_back("threads", std::vector<std::string>{ "2" });
  RunOptions job = MakeRunOptions("bunny", given);
  job.Out = folder / "results";
  WriteTextAtomically(job.Out / "job.json", JobText(job));
  RunOptions again = MakeRunOptions(job.Out / "job.json", {});
  EXPECT_EQ(again.Out.lexically_normal(), (folder / "results/").lexically_normal());
  EXPECT_EQ(again.Input.Dataset, std::filesystem::absolute("bunny"));
  EXPECT_EQ(again.Synthesis.Hull.Box, job.Synthesis.Hull.Box);
  // Every option but the number of threads and the renderer, which change no novel view, is in the
  // file.
  const nlohmann::ordered_json object = ReadJsonFile(job.Out / "job.json");
  EXPECT_EQ(object.size(), OptionsOf(job).size() - 2);
  EXPECT_FALSE(object.contains("threads"));
  EXPECT_FALSE(object.contains("renderer"));
  EXPECT_EQ(object["out"], ".");
  // Written again, wherever it is, the same bytes.
  EXPECT_EQ(JobText(again), ReadText(job.Out / "job.json"));
  again.Out = folder / "elsewhere";
  EXPECT_EQ(JobText(again), ReadText(job.Out / "job.json"));
}

TEST(Job, BadJobFilesAreNamed)
{
  const TemporaryFolder folder;
  const auto expect = [&folder](const std::string& text, const auto&... parts)
  {
    WriteText(folder / "job.json", text);
    ExpectError([&] { MakeRunOptions(folder / "job.json", Minimal()); }, "job.json", parts...);
  };
  expect(R"({"dataset": "d", "hullSpacin": 2})", "unknown key \"hullSpacin\"",
    "did you mean \"hullSpacing\"?");
  expect(R"({"dataset": "d", "zzzzzz": 2})", "unknown key \"zzzzzz\"");
  expect(R"({"dataset": "d", "hullSpacing": "2"})", "key \"hullSpacing\"", "wrong type",
    "string \"2\"", "expected a number");
  expect(R"({"dataset": "d", "references": 2.5})", "key \"references\"", "a whole number");
  expect(R"({"dataset": "d", "references": 99})", "out of range", "got 99", "1 to 64");
  expect(R"({"dataset": "d", "hullKeepAll": 1})", "key \"hullKeepAll\"", "true or false");
  expect(R"({"dataset": "d", "exclude": "a"})", "key \"exclude\"", "an array of texts");
  expect(R"({"dataset": "d", "hullBox": [1, 2]})", "key \"hullBox\"", "an array of 6 numbers");
  expect(R"({"dataset": "d", "preset": "quick"})", "best, paper");
  expect(R"({"dataset": "d", "power": 1, "power": 2})", "key \"power\" is there twice");
  expect(R"({"dataset": "d",)", "is not JSON");
  expect(R"([1])", "got array, expected a JSON object");
  expect(R"({"power": 1})", "no data set given");
}

TEST(ViewSpec, TextReadsBackTheSame)
{
  for (const char* text :
    { "between:0,1,0.25", "between:a.png,b.png,1", "like:a.png", "file:dir#1/x_par.txt#a.png" })
  {
    EXPECT_EQ(ViewSpecText(ParseViewSpec(text)), text);
  }
  EXPECT_EQ(ParseViewSpec("between:0,1").Fraction, 0.5);
  EXPECT_EQ(ParseViewSpec("file:dir#1/x_par.txt#a.png").ParFile, "dir#1/x_par.txt");
}

TEST(ViewSpec, BadTextIsRefused)
{
  for (const char* text :
    { "between", "between:", "between:0", "between:0,", "between:0,1,2", "between:0,1,x",
      "like:", "like", "file:a_par.txt", "file:#a", "file:a#", "beside:a", "between:0,1,nan" })
  {
    ExpectError([text] { ParseViewSpec(text); }, "view", text, "expected between:A,B[,FRACTION]");
  }
}

TEST(ViewSpec, BetweenIsTheCameraOnTheOrbit)
{
  const TemporaryFolder folder;
  const DatasetIndex dataset = MakeDataset(folder);
  for (const char* text : { "between:0,1", "between:c0.png,c1.png,0.5" })
  {
    const ResolvedView view = ResolveViewSpec(ParseViewSpec(text), dataset);
    const double a = EIGEN_PI / 12;
    // Cameras are rounded to 2^-26 (CameraGrid).
    EXPECT_LT(
      (view.Cam.Centre() - Eigen::Vector3d(3 * std::sin(a), 0, 3 * std::cos(a))).norm(), 1e-7);
    EXPECT_EQ(SizeText(view.Cam.Width, view.Cam.Height), "32x24");
    EXPECT_TRUE(view.HeldOut.empty());
    EXPECT_TRUE(view.Truth.File.empty());
  }
}

TEST(ViewSpec, LikeHoldsThePhotographOut)
{
  const TemporaryFolder folder;
  const DatasetIndex dataset = MakeDataset(folder);
  ResolvedView view = ResolveViewSpec(ParseViewSpec("like:c1.png"), dataset);
  EXPECT_EQ(view.HeldOut, "c1.png");
  EXPECT_EQ(view.Truth.File, folder / "c1.png");
  EXPECT_TRUE(view.Truth.Mask.empty());
  EXPECT_TRUE(view.Cam.R.isApprox(dataset.Cameras[1].Cam.R, 1e-7));
  EXPECT_EQ(SizeText(view.Cam.Width, view.Cam.Height), "40x30");
  WriteImageFile(folder / "mask/c1.png", Image<std::uint8_t>(40, 30).Ref());
  view = ResolveViewSpec(ParseViewSpec("like:c1.png"), ReadDatasetIndex(folder.Path));
  EXPECT_EQ(view.Truth.Mask, folder / "mask/c1.png");
}

TEST(ViewSpec, FileTakesTheCameraAndThePictureBesideItAsTruth)
{
  const TemporaryFolder folder;
  const DatasetIndex dataset = MakeDataset(folder);
  WriteCameras(folder / "test/t_par.txt",
    { { "t0.png", dataset.Cameras[2].Cam }, { "t1.png", dataset.Cameras[3].Cam } });
  WriteImageFile(folder / "test/t1.png", Image<std::uint8_t>(50, 20, 3).Ref());
  const std::string file = "file:" + (folder / "test/t_par.txt").string();
  const ResolvedView without = ResolveViewSpec(ParseViewSpec(file + "#t0.png"), dataset);
  EXPECT_EQ(without.Cam.T, dataset.Cameras[2].Cam.T);
  EXPECT_EQ(SizeText(without.Cam.Width, without.Cam.Height), "32x24");
  EXPECT_TRUE(without.Truth.File.empty());
  const ResolvedView with = ResolveViewSpec(ParseViewSpec(file + "#t1.png"), dataset);
  EXPECT_EQ(SizeText(with.Cam.Width, with.Cam.Height), "50x20");
  EXPECT_EQ(with.Truth.File, folder / "test/t1.png");
  EXPECT_TRUE(with.HeldOut.empty());
  // Asked for by the data set's own calibration, a photograph is held out all the same.
  const ResolvedView own =
    ResolveViewSpec(ParseViewSpec("file:" + (folder / "c_par.txt").string() + "#c1.png"), dataset);
  EXPECT_EQ(own.HeldOut, "c1.png");
}

TEST(ViewSpec, UnknownCamerasAreNamed)
{
  const TemporaryFolder folder;
  const DatasetIndex dataset = MakeDataset(folder);
  const auto resolve = [&dataset](const std::string& text)
  { return [&dataset, text] { ResolveViewSpec(ParseViewSpec(text), dataset); }; };
  ExpectError(resolve("between:0,4"), "no camera of this number", "got 4, expected 0 to 3");
  ExpectError(resolve("like:c9.png"), "c_par.txt has no camera", "'c9.png'", "like c0.png");
  ExpectError(resolve("file:nowhere_par.txt#a"), "nowhere_par.txt", "no such file");
  ExpectError(resolve(""), "view", "none given");
}
