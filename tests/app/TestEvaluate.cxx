// SPDX-License-Identifier: GPL-3.0-or-later
// `novelview evaluate`, by the built program: it scores what `novelview run` scores.
#include "support/ProgramRun.h"

#include "images/ImageFile.h"

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;
using testing::HasSubstr;

namespace
{
/** A small bunny for all tests here; a view takes about a second. */
class Evaluate : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    Bunny = std::make_unique<GeneratedData>(std::vector<std::string>{
      "--views", "8", "--step", "45", "--size", "160x120", "--test-angles", "15,200" });
  }
  static void TearDownTestSuite() { Bunny.reset(); }

  static fs::path Out(const std::string& out) { return Bunny->Folder / out; }
  static std::vector<std::string> Words(
    const std::string& command, const std::string& out, const std::vector<std::string>& more)
  {
    return With({ command, Bunny->Data().string(), "--out", Out(out).string() }, more);
  }
  static void Run(const std::string& out, const std::vector<std::string>& more)
  {
    MustRun(Words("run", out, With({ "--quiet", "--no-iterations" }, more)));
  }

  static inline std::unique_ptr<GeneratedData> Bunny;
};

/** The numbers of a line of scores.csv. */
std::vector<double> CsvLine(const fs::path& out, const std::string& view, const std::string& stage)
{
  std::istringstream text(ReadText(out / "scores.csv"));
  const std::string begin = view + "," + stage + ",";
  for (std::string line; std::getline(text, line);)
  {
    if (line.starts_with(begin))
    {
      std::istringstream cells(line.substr(begin.size()));
      std::vector<double> numbers;
      for (std::string cell; std::getline(cells, cell, ',');)
      {
        numbers.push_back(std::stod(cell));
      }
      return numbers;
    }
  }
  return {};
}

/** Expects the scores of a view to be those of a run, bit for bit. */
void ExpectScoresOfRun(const fs::path& evaluated, const std::string& view, const fs::path& run)
{
  const nlohmann::json stages = ReadJson(run / "summary.json").at("stages");
  for (const auto& [stage, scores] : stages.items())
  {
    std::vector<double> expected;
    for (const char* name : { "rms", "psnr", "ssim", "iou", "missing", "excess" })
    {
      expected.push_back(scores.at(name).get<double>());
    }
    EXPECT_EQ(CsvLine(evaluated, view, stage), expected) << view << " " << stage;
  }
}
}

TEST_F(Evaluate, TestViewsAreScoredAsRunDoes)
{
  const ProcessEnd end = RunProgram(Words("evaluate", "tests", {}));
  ASSERT_EQ(end.Code, 0) << end.Err;
  // The second view: what the first one left behind must not matter.
  Run(
    "run", { "--view", Bunny->HeldOut(1), "--true-mesh", (Bunny->Data() / "truth.ply").string() });
  const fs::path out = Out("tests");
  ExpectScoresOfRun(out, "test0001.png", Out("run"));
  for (const std::string stage : { "hull", "outline", "full", "oracle" })
  {
    EXPECT_TRUE(ReadText(out / ("test0001." + stage + ".png")) ==
      ReadText(Out("run") / "stages" / (stage + ".png")))
      << stage;
    EXPECT_EQ(CsvLine(out, "test0000.png", stage).size(), 6u) << stage;
  }
  EXPECT_GT(ReadPictureSize(out / "overview.png").Width, 0);
  EXPECT_GT(ReadPictureSize(out / "chart.png").Width, 0);
  EXPECT_TRUE(HalfWritten(out).empty());

  const nlohmann::json summary = ReadJson(out / "scores.json");
  EXPECT_EQ(summary.at("mode"), "test views");
  EXPECT_EQ(summary.at("views").size(), 2u);
  EXPECT_EQ(summary.at("views")[1].at("references"), 8);
  EXPECT_EQ(summary.at("options").at("preset"), "best");
  EXPECT_EQ(summary.at("options").at("trueMesh"),
    fs::weakly_canonical(Bunny->Data() / "truth.ply").string());
  EXPECT_TRUE(summary.at("versions").contains("novelview"));
  const nlohmann::json mean = summary.at("mean");
  EXPECT_EQ(mean.at("full").at("rms").get<double>(),
    CsvLine(out, "test0000.png", "full")[0] / 2 + CsvLine(out, "test0001.png", "full")[0] / 2);
  // The table, and a warning for exactly those views that it is due for.
  EXPECT_THAT(end.Out, HasSubstr("\nmean of 2     oracle  "));
  EXPECT_THAT(end.Out, HasSubstr("\ngap from the hull to the oracle closed: RMS "));
  for (const std::string view : { "test0000.png", "test0001.png" })
  {
    const bool worse = CsvLine(out, view, "full")[0] > CsvLine(out, view, "hull")[0];
    EXPECT_EQ(end.Err.find(view) != std::string::npos, worse) << end.Err;
  }
}

TEST_F(Evaluate, PhotographsHeldOutTogetherAreNoReferences)
{
  MustRun(Words("evaluate", "hold",
    { "--quiet", "--hold-out", "bunny0002.png,bunny0005.png", "--stage", "outline",
      "--no-pictures" }));
  Run(
    "like", { "--view", "like:bunny0005.png", "--exclude", "bunny0002.png", "--stage", "outline" });
  ExpectScoresOfRun(Out("hold"), "bunny0005.png", Out("like"));
  EXPECT_TRUE(CsvLine(Out("hold"), "bunny0005.png", "full").empty());
  const nlohmann::json summary = ReadJson(Out("hold") / "scores.json");
  EXPECT_EQ(summary.at("views")[0].at("references"), 6);
  EXPECT_FALSE(summary.at("mean").contains("oracle"));
  std::vector<std::string> names;
  for (const auto& [name, content] : FilesBelow(Out("hold")))
  {
    names.push_back(name);
  }
  EXPECT_THAT(names, testing::ElementsAre("chart.png", "report.html", "scores.csv", "scores.json"));
}

TEST_F(Evaluate, EveryKthIsTheSameAsNamingThem)
{
  MustRun(
    Words("evaluate", "every", { "--quiet", "--every", "4", "--stage", "hull", "--no-pictures" }));
  WriteText(Bunny->Folder / "job.json",
    R"({"dataset": "data", "out": "named", "holdOut": ["bunny0000.png", "bunny0004.png"],
      "stage": "hull", "pictures": false})");
  MustRun({ "evaluate", (Bunny->Folder / "job.json").string(), "--quiet" });
  EXPECT_FALSE(CsvLine(Out("every"), "bunny0004.png", "hull").empty());
  EXPECT_EQ(ReadText(Out("every") / "scores.csv"), ReadText(Out("named") / "scores.csv"));
}

TEST_F(Evaluate, EachPhotographIsPredictedFromAllOthers)
{
  MustRun(Words("evaluate", "each", { "--quiet", "--leave-one-out", "--stage", "hull" }));
  Run("one", { "--view", "like:bunny0006.png", "--stage", "hull" });
  ExpectScoresOfRun(Out("each"), "bunny0006.png", Out("one"));
  const nlohmann::json views = ReadJson(Out("each") / "scores.json").at("views");
  ASSERT_EQ(views.size(), 8u);
  for (const nlohmann::json& view : views)
  {
    EXPECT_EQ(view.at("references"), 7);
  }
  EXPECT_TRUE(fs::exists(Out("each") / "bunny0007.hull.png"));
}

TEST_F(Evaluate, BadUsageLeavesNothing)
{
  const auto expect = [](const std::vector<std::string>& more, int code, const std::string& part)
  {
    const ProcessEnd end = RunProgram(Words("evaluate", "bad", more));
    EXPECT_EQ(end.Code, code);
    EXPECT_THAT(end.Err, HasSubstr(part));
    EXPECT_EQ(std::count(end.Err.begin(), end.Err.end(), '\n'), 1) << end.Err;
    EXPECT_FALSE(fs::exists(Out("bad")));
  };
  expect({ "--hold-out", "nobody.png" }, 2, "no photograph of this name (got 'nobody.png'");
  expect({ "--every", "2", "--leave-one-out" }, 2, "cannot be given with --every");
  expect({ "--every", "1" }, 2, "--every: leaves no photograph");
  expect({ "--calibration", "nowhere_par.txt" }, 1, "nowhere_par.txt");
}

TEST_F(Evaluate, FailureNamesTheViewAndLeavesNoScores)
{
  const fs::path copy = Bunny->Folder / "copy";
  fs::copy(Bunny->Data(), copy, fs::copy_options::recursive);
  WriteImageFile(copy / "test/mask/test0001.png", Image<std::uint8_t>(160, 120).Ref());
  const ProcessEnd end = RunProgram({ "evaluate", copy.string(), "--quiet", "--out",
    Out("failed").string(), "--stage", "hull", "--no-pictures" });
  EXPECT_EQ(end.Code, 1);
  EXPECT_THAT(end.Err, HasSubstr("view test0001.png: mask of the true picture: is empty"));
  EXPECT_FALSE(fs::exists(Out("failed") / "scores.json"));
}
