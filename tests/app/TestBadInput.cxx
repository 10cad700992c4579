// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever is wrong with the input: one clear line, exit code 1 or 2, nothing half-written.
#include "support/ProgramRun.h"

#include "core/PrintableText.h"
#include "formats/Middlebury.h"
#include "images/ImageFile.h"

#include <functional>

using namespace novelview;
using namespace novelview::testing_support;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace
{
constexpr int Width = 160;
constexpr int Height = 120;

/** Six small photographs of the bunny, copied for every test and then spoilt. */
class BadInput : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    Bunny = std::make_unique<GeneratedData>(
      std::vector<std::string>{ "--views", "6", "--step", "60", "--size", "160x120" });
  }
  static void TearDownTestSuite() { Bunny.reset(); }

  void SetUp() override { fs::copy(Bunny->Data(), this->Data, fs::copy_options::recursive); }

  /** Runs and expects a failure said in one line with all these parts. */
  void ExpectFailure(int code, const std::vector<std::string>& parts,
    const std::vector<std::string>& more = {}, const std::string& dataset = "")
  {
    std::vector<std::string> words{ "run", dataset.empty() ? this->Data.string() : dataset,
      "--quiet", "--outline-iterations", "1", "--non-outline-iterations", "1", "--no-screenshots" };
    const auto given = [&more](const std::string& option)
    { return std::find(more.begin(), more.end(), option) != more.end(); };
    words = given("--view") ? words : With(words, { "--view", "between:0,1" });
    words = given("--out") ? words : With(words, { "--out", this->Out.string() });
    const ProcessEnd end = RunProgram(With(words, more));
    ExpectLine(end, code, parts);
    // No stage has ended well enough to be written, so there is nothing at all.
    EXPECT_THAT(FilesBelow(this->Out), testing::IsEmpty());
  }

  /** Expects the end of a program that says one printable line with all these parts. */
  static void ExpectLine(const ProcessEnd& end, int code, const std::vector<std::string>& parts)
  {
    EXPECT_EQ(end.Code, code) << end.Err;
    EXPECT_THAT(end.Err, testing::StartsWith("novelview: error: "));
    EXPECT_EQ(std::count(end.Err.begin(), end.Err.end(), '\n'), 1) << end.Err;
    EXPECT_LE(end.Err.size(), MaxInLine + std::string("novelview: error: \n").size());
    EXPECT_TRUE(IsUtf8(end.Err)) << end.Err;
    for (const std::string& part : parts)
    {
      EXPECT_THAT(end.Err, HasSubstr(part));
    }
    for (const char* foreign : { "exception", "std::", "OpenCV(", "yaml-cpp", ".cxx", "basic_" })
    {
      EXPECT_THAT(end.Err, testing::Not(HasSubstr(foreign)));
    }
  }

  /**
   * Replaces a word (0 = name, 1 = k11, 10 = r11, 19 = t1) in the line of photograph 2; returns the
   * old one.
   */
  std::string SetCalibrationWord(std::size_t word, const std::string& text)
  {
    std::string old;
    std::istringstream lines(ReadText(this->Data / "bunny_par.txt"));
    std::string result;
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number)
    {
      std::istringstream stream(line);
      std::size_t at = 0;
      std::string changed;
      for (std::string each; stream >> each; ++at)
      {
        const bool meant = number == 4 && at == word;
        old = meant ? each : old;
        changed += (meant ? text : each) + " ";
      }
      result += changed + "\n";
    }
    WriteText(this->Data / "bunny_par.txt", result);
    return old;
  }

  void SetMask(const std::function<bool(int x, int y)>& inside)
  {
    Image<std::uint8_t> mask(Width, Height);
    for (int y = 0; y < Height; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        mask(x, y) = inside(x, y) ? 255 : 0;
      }
    }
    WriteImageFile(this->Data / "mask" / "bunny0002.png", mask.Ref());
  }

  /** Cuts a file in two halves and keeps the first. */
  static void Truncate(const fs::path& file) { fs::resize_file(file, fs::file_size(file) / 2); }

  /** Writes a camera that the run is asked for. */
  std::vector<std::string> ViewFrom(const Eigen::Vector3d& centre, const Eigen::Vector3d& target)
  {
    const Eigen::Matrix3d K = ReadCameras(this->Data / "bunny_par.txt").front().Cam.K;
    const fs::path file = this->Folder / "view.txt";
    WriteCameras(
      file, { { "view", LookAt(centre, target, Eigen::Vector3d::UnitY(), K, Width, Height) } });
    return { "--view", "file:" + file.string() + "#view" };
  }

  /** What all cameras look at, and camera 0. */
  Eigen::Vector3d Target() const
  {
    std::vector<Camera> cameras;
    for (const NamedCamera& camera : ReadCameras(this->Data / "bunny_par.txt"))
    {
      cameras.push_back(camera.Cam);
    }
    return CommonTarget(cameras.data(), cameras.size());
  }
  Eigen::Vector3d Centre() const
  {
    return ReadCameras(this->Data / "bunny_par.txt").front().Cam.Centre();
  }

  static inline std::unique_ptr<GeneratedData> Bunny;
  const TemporaryFolder Folder;
  const fs::path Data = Folder / "data";
  const fs::path Out = Folder / "out";
};
}

TEST_F(BadInput, TheDataItselfIsGood)
{
  MustRun({ "run", this->Data.string(), "--quiet", "--view", "between:0,1", "--stage", "hull",
    "--no-iterations", "--out", this->Out.string() });
  EXPECT_TRUE(HalfWritten(this->Out).empty());
}

TEST_F(BadInput, MissingFolder)
{
  this->ExpectFailure(1, { "nowhere", "no such folder" }, {}, (this->Folder / "nowhere").string());
}

TEST_F(BadInput, FolderWithoutCalibration)
{
  fs::remove(this->Data / "bunny_par.txt");
  this->ExpectFailure(1, { "no calibration file" });
}

TEST_F(BadInput, MissingPhotograph)
{
  fs::remove(this->Data / "bunny0002.png");
  this->ExpectFailure(1, { "bunny0002.png", "no such file" });
}

TEST_F(BadInput, TruncatedPhotograph)
{
  Truncate(this->Data / "bunny0002.png");
  this->ExpectFailure(1, { "bunny0002.png", "cannot be read" });
}

TEST_F(BadInput, TruncatedMask)
{
  Truncate(this->Data / "mask" / "bunny0002.png");
  this->ExpectFailure(1, { "mask/bunny0002.png", "cannot be read" });
}

TEST_F(BadInput, PhotographThatIsNone)
{
  WriteText(this->Data / "bunny0002.png", "this is not a picture\n");
  this->ExpectFailure(1, { "bunny0002.png", "cannot be read" });
}

TEST_F(BadInput, MaskOfAnotherSize)
{
  WriteImageFile(this->Data / "mask/bunny0002.png", Image<std::uint8_t>(80, 60, 1, 255).Ref());
  this->ExpectFailure(1, { "mask/bunny0002.png", "got 80x60", "expected 160x120" });
}

TEST_F(BadInput, PhotographOfAnotherSizeThanTheOthersWithItsCalibration)
{
  Image<std::uint8_t> mask(80, 60);
  std::fill(mask.Values.begin() + 2000, mask.Values.end() - 2000, 255);
  WriteImageFile(this->Data / "mask/bunny0002.png", mask.Ref());
  WriteImageFile(this->Data / "bunny0002.png", Image<std::uint8_t>(80, 60, 3, 99).Ref());
  this->ExpectFailure(
    1, { "view bunny0002.png", "bunny0000.png", "got 80x60", "expected 160x120" });
}

TEST_F(BadInput, TruthOfAnotherSize)
{
  WriteImageFile(this->Folder / "truth.png", Image<std::uint8_t>(80, 60, 3, 99).Ref());
  this->ExpectFailure(1, { "truth.png", "got 80x60", "expected 160x120" },
    { "--truth", (this->Folder / "truth.png").string() });
}

TEST_F(BadInput, MalformedCalibrationLine)
{
  this->SetCalibrationWord(3, "1.2x");
  this->ExpectFailure(1, { "bunny_par.txt, line 4", "value 3", "'1.2x'" });
}

TEST_F(BadInput, ShortCalibrationLine)
{
  this->SetCalibrationWord(21, "");
  this->ExpectFailure(1, { "bunny_par.txt, line 4", "calibration line is short", "got 20" });
}

TEST_F(BadInput, SingularK)
{
  this->SetCalibrationWord(1, "0");
  this->ExpectFailure(1, { "bunny_par.txt, line 4", "bunny0002.png", "K is singular" });
}

TEST_F(BadInput, RThatIsNoRotation)
{
  this->SetCalibrationWord(10, "5");
  this->ExpectFailure(1, { "bunny_par.txt, line 4", "bunny0002.png", "R is not a rotation" });
}

TEST_F(BadInput, CameraNumbersThatOverflowAreImplausible)
{
  const std::vector<std::pair<std::size_t, std::string>> words{ { 1, "focal length fx" },
    { 3, "principal point cx" }, { 5, "focal length fy" }, { 6, "principal point cy" },
    { 19, "translation" } };
  for (const auto& [word, name] : words)
  {
    const std::string old = this->SetCalibrationWord(word, "1e308");
    this->ExpectFailure(1, { "bunny_par.txt, line 4", name + " is out of range", "1e+308" });
    ExpectLine(RunProgram({ "check", this->Data.string(), "--quiet" }), 1, { name });
    this->SetCalibrationWord(word, old);
  }
  this->SetCalibrationWord(3, "-1e308");
  this->ExpectFailure(1, { "principal point cx is out of range", "got -1e+308" });
}

TEST_F(BadInput, AViewsCameraIsCheckedLikeThePhotographs)
{
  const std::string view = ReadText(this->Data / "bunny_par.txt");
  this->SetCalibrationWord(3, "1e308");
  fs::rename(this->Data / "bunny_par.txt", this->Folder / "view.txt");
  WriteText(this->Data / "bunny_par.txt", view);
  this->ExpectFailure(1, { "view.txt, line 4", "principal point cx is out of range" },
    { "--view", "file:" + (this->Folder / "view.txt").string() + "#bunny0000.png" });
  WriteText(this->Folder / "path.json",
    R"({"keys": [{"camera": 0}, {"R": [1,0,0,0,1,0,0,0,1], "t": [0,0,1e308]}]})");
  ExpectLine(RunProgram({ "orbit", this->Data.string(), "--quiet", "--out", this->Out.string(),
               "--path", (this->Folder / "path.json").string() }),
    1, { "path.json, key camera 1", "translation is out of range" });
}

TEST_F(BadInput, WordsOfTenMegabytesAreNotSaidBack)
{
  WriteText(this->Data / "bunny_par.txt", std::string(10000000, 'a'));
  this->ExpectFailure(1, { "bunny_par.txt, line 1", "not a count of photographs", "aaa..." });
  this->ExpectFailure(2, { "unknown option --xxx", "..." }, { "--" + std::string(100000, 'x') });
  this->ExpectFailure(2, { "unknown option --\\x1B[31m" }, { "--\x1B[31m" });
}

TEST_F(BadInput, JsonNestedAHundredThousandDeepIsNoCrash)
{
  const std::string nested = std::string(100000, '[') + std::string(100000, ']');
  const fs::path job = this->Data / "job.json";
  WriteText(job, R"({"dataset": ".", "references": )" + nested + "}");
  this->ExpectFailure(2, { "job.json, line 1", "nested too deep" }, {}, job.string());
  WriteText(
    job, R"({"keys": [{"position": )" + nested + R"(, "lookAt": [0,0,0]}, {"camera": 0}]})");
  ExpectLine(RunProgram({ "orbit", this->Data.string(), "--quiet", "--out", this->Out.string(),
               "--path", job.string() }),
    2, { "job.json, line 1", "nested too deep" });
}

TEST_F(BadInput, DamagedFilesOfOpenCvAreNoCrash)
{
  const std::string header = "%YAML:1.0\n---\ncamera_matrix: ";
  const std::vector<std::pair<std::string, std::string>> files{
    { "c.yml", header + std::string(50000, '[') },
    { "c.yml", header + "!!opencv-matrix\n   rows: 99999999\n   cols: 99999999\n   dt: d\n" },
    { "c.xml", "<?xml version=\"1.0\"?>\n<opencv_storage>\n<camera_matrix type_id=\"opencv-mat" },
  };
  fs::remove(this->Data / "bunny_par.txt");
  for (const auto& [name, text] : files)
  {
    WriteText(this->Data / name, text);
    ExpectLine(RunProgram({ "check", this->Data.string(), "--quiet" }), 1, { name });
    fs::remove(this->Data / name);
  }
}

TEST_F(BadInput, AFolderThatJobJsonCannotNameIsRefusedBeforeTheWork)
{
  const fs::path folder = this->Folder / "caf\xE9";
  fs::rename(this->Data, folder);
  this->ExpectFailure(1, { "dataset", "is not UTF-8", "caf\\xE9" }, {}, folder.string());
}

TEST_F(BadInput, PhotographsWithNamesThatAreNoUtf8AreNoHindrance)
{
  const std::string name = "caf\xE9.png";
  this->SetCalibrationWord(0, name);
  fs::rename(this->Data / "bunny0002.png", this->Data / name);
  fs::rename(this->Data / "mask" / "bunny0002.png", this->Data / "mask" / name);
  MustRun({ "run", this->Data.string(), "--quiet", "--view", "between:2,3", "--stage", "hull",
    "--no-depth-maps", "--no-iterations", "--out", this->Out.string() });
  EXPECT_TRUE(fs::exists(this->Out / "summary.json"));
  EXPECT_NO_THROW(ReadJson(this->Out / "summary.json"));
  MustRun({ "check", this->Data.string(), "--quiet", "--out", (this->Folder / "check").string() });
  EXPECT_NO_THROW(ReadJson(this->Folder / "check" / "check.json"));
}

TEST_F(BadInput, EmptyMask)
{
  this->SetMask([](int, int) { return false; });
  this->ExpectFailure(1, { "bunny0002.png", "silhouette is empty" });
}

TEST_F(BadInput, MaskThatCarvesEverythingAwayIsNamed)
{
  // In the corner, where no other view has the object; large enough to be believed as a mask.
  this->SetMask([](int x, int y) { return x >= 2 && x < 25 && y >= 2 && y < 25; });
  this->ExpectFailure(1, { "visual hull: view bunny0002.png", "no point in common" });
}

TEST_F(BadInput, BoxBesideTheObject)
{
  this->ExpectFailure(1, { "novelview: error: visual hull: it is empty in the search box" },
    { "--hull-box", "50,50,50,51,51,51" });
}

TEST_F(BadInput, BoxThroughTheObjectBoundsTheHullAndIsSaid)
{
  const ProcessEnd end =
    RunProgram({ "run", this->Data.string(), "--quiet", "--no-screenshots", "--view", "between:0,1",
      "--out", this->Out.string(), "--hull-box=-1.2,-0.2,-1.2,1.2,1.2,1.2" });
  EXPECT_EQ(end.Code, 0) << end.Err;
  EXPECT_THAT(end.Err, HasSubstr("warning: visual hull: cut at the box of --hull-box"));
}

TEST_F(BadInput, BoxTurnedInsideOut)
{
  this->ExpectFailure(2, { "--hull-box" }, { "--hull-box", "1,1,1,-1,-1,-1" });
}

TEST_F(BadInput, VirtualCameraInsideTheObject)
{
  const Eigen::Vector3d target = this->Target();
  this->ExpectFailure(1, { "novel camera", "inside the object" },
    this->ViewFrom(target, 2 * target - this->Centre()));
}

TEST_F(BadInput, VirtualCameraLookingAway)
{
  const Eigen::Vector3d centre = this->Centre();
  this->ExpectFailure(
    1, { "novel camera", "faces away" }, this->ViewFrom(centre, 2 * centre - this->Target()));
}

TEST_F(BadInput, VirtualCameraTooFarAwayGivesNoBlankPicture)
{
  const Eigen::Vector3d target = this->Target();
  this->ExpectFailure(1, { "novel camera", "covers no pixel" },
    this->ViewFrom(target + 1e6 * (this->Centre() - target), target));
}

TEST_F(BadInput, OutputThatCannotBeWritten)
{
  WriteText(this->Folder / "file", "not a folder");
  this->ExpectFailure(
    1, { "cannot make the folder" }, { "--out", (this->Folder / "file" / "below").string() });
  EXPECT_EQ(ReadText(this->Folder / "file"), "not a folder");
}

TEST_F(BadInput, TrueMeshThatCannotBeReadIsSaidBeforeTheWork)
{
  this->ExpectFailure(1, { "nowhere.ply", "does not exist" },
    { "--true-mesh", (this->Folder / "nowhere.ply").string() });
  WriteText(this->Folder / "cut.ply", "ply\nformat ascii 1.0\nelement vertex 5\n");
  this->ExpectFailure(1, { "cut.ply, line ", "no end_header" },
    { "--true-mesh", (this->Folder / "cut.ply").string() });
}

TEST_F(BadInput, UnknownOptionPresetAndView)
{
  this->ExpectFailure(2, { "unknown option --hull-spaccing, did you mean --hull-spacing?" },
    { "--hull-spaccing", "2" });
  this->ExpectFailure(2, { "--preset", "got 'bst'", "best, paper" }, { "--preset", "bst" });
  this->ExpectFailure(2, { "bunny99.png", "bunny0000.png" }, { "--view", "like:bunny99.png" });
  this->ExpectFailure(2, { "got 77", "0 to 5" }, { "--view", "between:0,77" });
}

TEST_F(BadInput, UnknownJobKeyIsNamedWithTheOneThatWasMeant)
{
  const fs::path job = this->Data / "job.json";
  WriteText(job, R"({ "dataset": ".", "hullSpaccing": 2 })");
  this->ExpectFailure(
    2, { "job.json", "\"hullSpaccing\"", "did you mean \"hullSpacing\"?" }, {}, job.string());
  WriteText(job, R"({ "dataset": ".",)");
  this->ExpectFailure(2, { "job.json", "is not JSON" }, {}, job.string());
}

TEST_F(BadInput, RenderSaysWhatIsWrongToo)
{
  const Eigen::Vector3d centre = this->Centre();
  this->ViewFrom(centre, 2 * centre - this->Target());
  const ProcessEnd end = RunProgram({ "render", this->Data.string(), "--quiet", "--stage", "hull",
    "--cameras", (this->Folder / "view.txt").string(), "--out", this->Out.string() });
  EXPECT_EQ(end.Code, 1);
  EXPECT_THAT(end.Err, HasSubstr("faces away"));
  EXPECT_EQ(std::count(end.Err.begin(), end.Err.end(), '\n'), 1) << end.Err;
  EXPECT_THAT(FilesBelow(this->Out), testing::IsEmpty());
}

TEST_F(BadInput, InterruptedRunLeavesNoHalfWrittenFile)
{
  // Work for minutes, so that it is not done when the signal comes, once the first files are there.
  const std::string command = ShellQuoted(NOVELVIEW_PROGRAM) + " run " +
    ShellQuoted(this->Data.string()) +
    " --quiet --view between:0,1 --outline-iterations 1000 --non-outline-iterations 1000" +
    " --preset paper --out " + ShellQuoted(this->Out.string()) + " & program=$!\n" +
    "for i in $(seq 600); do [ -e " + ShellQuoted((this->Out / "iterations").string()) +
    " ] && break; sleep 0.1; done\n" +
    "kill -INT $program; start=$(date +%s%N); wait $program; code=$?\n" +
    "echo $(( ($(date +%s%N) - start) / 1000000 )); exit $code";
  const ProcessEnd end = RunShell(command);
  EXPECT_EQ(end.Code, 130);
  EXPECT_EQ(end.Err, "novelview: error: interrupted\n");
  // One iteration with its screenshot is what must be finished first; a second on a free machine.
  EXPECT_LT(std::stoi(end.Out), 10000);
  EXPECT_TRUE(fs::exists(this->Out / "iterations"));
  EXPECT_FALSE(fs::exists(this->Out / "novel.png"));
  EXPECT_THAT(HalfWritten(this->Out), testing::IsEmpty());
}
