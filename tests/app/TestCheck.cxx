// SPDX-License-Identifier: GPL-3.0-or-later
// `novelview check` and `novelview mask`, by the built program.
#include "support/ProgramRun.h"

#include "images/ImageFile.h"

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;
using testing::HasSubstr;

namespace
{
/** A small bunny seen from above for all tests here. */
class CheckProgram : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    Bunny = std::make_unique<GeneratedData>(std::vector<std::string>{
      "--views", "8", "--step", "45", "--size", "200x150", "--elevation", "20" });
  }
  static void TearDownTestSuite() { Bunny.reset(); }

  static std::string Data() { return Bunny->Data().string(); }
  static fs::path In(const std::string& name) { return Bunny->Folder / name; }

  static inline std::unique_ptr<GeneratedData> Bunny;
};
}

TEST_F(CheckProgram, ACleanDataSetIsExitCodeZero)
{
  const ProcessEnd end = RunProgram({ "check", Data(), "--out", In("clean").string() });
  EXPECT_EQ(end.Code, 0) << end.Out << end.Err;
  EXPECT_THAT(end.Out, HasSubstr("ok       no problems found"));
  EXPECT_EQ(ReadJson(In("clean") / "check.json")["problems"], false);
  EXPECT_EQ(ReadPictureSize(In("clean") / "cameras.png").Width, 1600);
  EXPECT_TRUE(HalfWritten(In("clean")).empty());
}

TEST_F(CheckProgram, TheCommandItGivesMendsTheDataSet)
{
  // Poses the other way round: R' and -R' t instead of R and t.
  MustRun({ "convert", Data(), In("wrong").string(), "--format", "middlebury", "--poses",
    "camera-to-world", "--quiet" });
  const ProcessEnd end =
    RunProgram({ "check", In("wrong").string(), "--out", In("json").string() });
  EXPECT_EQ(end.Code, 3) << end.Err;
  EXPECT_THAT(end.Out, HasSubstr("error    convention"));
  const ProcessEnd quiet = RunProgram({ "check", In("wrong").string(), "--quiet" });
  EXPECT_EQ(quiet.Code, 3);
  EXPECT_EQ(quiet.Out, "");
  EXPECT_THAT(quiet.Err, testing::StartsWith("novelview: error: convention: "));
  const auto finding = ReadJson(In("json") / "check.json")["findings"][0];
  EXPECT_EQ(finding["options"], (std::vector<std::string>{ "--poses", "camera-to-world" }));
  const std::string command = finding["command"].get<std::string>();
  ASSERT_TRUE(command.starts_with("novelview ")) << command;
  EXPECT_THAT(end.Out, HasSubstr(command));
  const ProcessEnd mended =
    RunShell(ShellQuoted(NOVELVIEW_PROGRAM) + command.substr(std::string("novelview").size()));
  EXPECT_EQ(mended.Code, 0) << mended.Err;
  EXPECT_EQ(RunProgram({ "check", In("wrong-mended").string() }).Code, 0);
  EXPECT_EQ(RunProgram({ "check", In("wrong").string(), "--poses", "camera-to-world" }).Code, 0);
}

TEST_F(CheckProgram, BadUseIsOneLineWithAnExitCode)
{
  const auto expect = [](const std::vector<std::string>& words, int code, const std::string& part)
  {
    const ProcessEnd end = RunProgram(words);
    EXPECT_EQ(end.Code, code);
    EXPECT_THAT(end.Err, HasSubstr(part));
    EXPECT_EQ(std::count(end.Err.begin(), end.Err.end(), '\n'), 1) << end.Err;
  };
  expect({ "check" }, 2, "dataset is required");
  expect({ "check", In("nowhere").string() }, 1, "no such folder");
  expect({ "check", Data(), "--poses", "camera" }, 2, "--poses: is not a valid choice");
  expect({ "mask", Data() }, 2, "--out: no folder for the masks given");
  expect(
    { "mask", Data(), "--out", "o", "--in-place" }, 2, "--in-place: cannot be given with --out");
  expect({ "mask", Data(), "--in-place" }, 2, "there is a mask already");
  expect(
    { "mask", Data(), "--out", "o", "--method", "magic" }, 2, "--method: is not a valid choice");
  expect(
    { "mask", Data(), "--out", "o", "--key", "1,2,3" }, 2, "of no use without --method chroma");
  expect({ "mask", Data(), "--out", "o", "--method", "grabcut", "--box", "1,2" }, 2,
    "--box: has the wrong length (got 2 numbers, expected 4)");
}

TEST_F(CheckProgram, MasksItWritesMakeACleanDataSet)
{
  fs::copy(Data(), In("bare"), fs::copy_options::recursive);
  fs::remove_all(In("bare") / "mask");
  const ProcessEnd end =
    RunProgram({ "mask", In("bare").string(), "--in-place", "--method", "dark" });
  EXPECT_EQ(end.Code, 0) << end.Err;
  EXPECT_THAT(end.Out, HasSubstr("8 masks written to"));
  const ProcessEnd checked = RunProgram({ "check", In("bare").string() });
  EXPECT_EQ(checked.Code, 0) << checked.Out;
  EXPECT_THAT(checked.Out, HasSubstr("masks        8 files"));
}
