// SPDX-License-Identifier: GPL-3.0-or-later
// Nothing of the user's is ever lost: no run replaces what it read, and every file is there whole or
// not at all.
#include "support/ProgramRun.h"

#include <sstream>

using namespace novelview;
using namespace novelview::testing_support;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace
{
/** What makes runs short: no depth maps, a coarse hull and nothing refined. */
const std::vector<std::string> Coarse{ "--quiet", "--stage", "hull", "--no-depth-maps",
  "--hull-spacing", "8" };

/** The lines that tell errors; coarse hulls have warnings, too. */
std::string ErrorsIn(const ProcessEnd& end)
{
  std::istringstream lines(end.Err);
  std::string errors;
  for (std::string line; std::getline(lines, line);)
  {
    errors += line.rfind("novelview: warning: ", 0) == 0 ? "" : line + "\n";
  }
  return errors;
}

/** Expects one line of error that names a file. */
void ExpectOneError(const ProcessEnd& end, const std::string& named)
{
  const std::string errors = ErrorsIn(end);
  EXPECT_EQ(end.Code, 1) << end.Err;
  EXPECT_THAT(errors, testing::StartsWith("novelview: error: "));
  EXPECT_THAT(errors, HasSubstr(named));
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
}

/** Six small photographs of the bunny, copied for every test. */
class Outputs : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    Bunny = std::make_unique<GeneratedData>(
      std::vector<std::string>{ "--views", "6", "--step", "60", "--size", "96x72" });
  }
  static void TearDownTestSuite() { Bunny.reset(); }

  void SetUp() override { fs::copy(Bunny->Data(), this->Data, fs::copy_options::recursive); }

  /** Expects a failure in one line that names the file, and every file of the folder as before. */
  void ExpectRefused(const std::vector<std::string>& words, const std::string& named)
  {
    const auto before = FilesBelow(this->Folder.Path);
    const ProcessEnd end = RunProgram(words);
    ExpectOneError(end, named);
    EXPECT_TRUE(FilesBelow(this->Folder.Path) == before) << "a file has changed";
  }

  /** Runs with files limited to this many blocks of 512 bytes, which fails like a full disk. */
  static ProcessEnd RunLimited(int blocks, const std::vector<std::string>& words)
  {
    std::string command =
      "ulimit -f " + std::to_string(blocks) + "; " + ShellQuoted(NOVELVIEW_PROGRAM);
    for (const std::string& word : words)
    {
      command += " " + ShellQuoted(word);
    }
    // What it says goes through a pipe, which has no limit.
    return RunShell("err=$( ( " + command + " ) 2>&1 >/dev/null ); code=$?\n" +
      "printf '%s\\n' \"$err\" >&2; exit $code");
  }

  /** Expects one clear line that names the file, and nothing of that name. */
  static void ExpectNotWritten(const ProcessEnd& end, const fs::path& file)
  {
    ExpectOneError(end, file.string());
    EXPECT_FALSE(fs::exists(file));
    EXPECT_THAT(HalfWritten(file.parent_path()), testing::IsEmpty());
  }

  static inline std::unique_ptr<GeneratedData> Bunny;
  TemporaryFolder Folder;
  const fs::path Data = this->Folder / "data";
};

/** A text with every `from` replaced. */
std::string Replaced(std::string text, const std::string& from, const std::string& to)
{
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
  {
    text.replace(at, from.size(), to);
  }
  return text;
}
}

// ---- never over what was read

TEST_F(Outputs, RenderIntoTheDatasetDoesNotReplacePhotographs)
{
  this->ExpectRefused(
    With({ "render", this->Data.string(), "--cameras", (this->Data / "bunny_par.txt").string(),
           "--out", this->Data.string() },
      Coarse),
    "bunny0000.png: would be replaced");
}

TEST_F(Outputs, RenderThroughAHardLinkDoesNotReplaceAPhotograph)
{
  fs::create_directory(this->Folder / "out");
  fs::create_hard_link(this->Data / "bunny0003.png", this->Folder / "out/bunny0003.png");
  this->ExpectRefused(
    With({ "render", this->Data.string(), "--cameras", (this->Data / "bunny_par.txt").string(),
           "--out", (this->Folder / "out").string() },
      Coarse),
    "bunny0003.png: would be replaced");
}

TEST_F(Outputs, OrbitDoesNotReplacePhotographsNamedLikeFrames)
{
  const fs::path named = this->Folder / "named";
  fs::create_directories(named / "mask");
  for (int i = 0; i < 6; ++i)
  {
    const std::string digits = "000" + std::to_string(i) + ".png";
    fs::copy(this->Data / ("bunny" + digits), named / ("frame_" + digits));
    fs::copy(this->Data / "mask" / ("bunny" + digits), named / "mask" / ("frame_" + digits));
  }
  WriteText(
    named / "a_par.txt", Replaced(ReadText(this->Data / "bunny_par.txt"), "bunny", "frame_"));
  this->ExpectRefused(
    With({ "orbit", named.string(), "--out", named.string(), "--frames", "2" }, Coarse),
    "frame_0000.png: would be replaced");
}

TEST_F(Outputs, ConvertUndistortingInPlaceDoesNotReplacePhotographs)
{
  const fs::path user = this->Folder / "user";
  MustRun({ "convert", this->Data.string(), (user / "photos").string(), "--format", "nerf", "-q" });
  fs::create_directory(user / "calib");
  std::string transforms = ReadText(user / "photos/transforms.json");
  transforms =
    Replaced(transforms, "\"file_path\": \"", "\"k1\": 0.01, \"file_path\": \"../photos/");
  transforms = Replaced(transforms, "\"mask_path\": \"", "\"mask_path\": \"../photos/");
  WriteText(user / "calib/transforms.json", transforms);
  fs::remove(user / "photos/transforms.json");
  const std::vector<std::string> words{ "convert", (user / "calib").string(), user.string(),
    "--format", "opencv", "--quiet" };
  this->ExpectRefused(With(words, { "--undistort" }), ".png: would be replaced");
  // Without undistorting the photographs stay as they are, and only the calibration is new.
  const auto before = FilesBelow(user / "photos");
  MustRun(words);
  EXPECT_TRUE(FilesBelow(user / "photos") == before);
}

TEST_F(Outputs, GenerateDoesNotReplaceTheMeshItReads)
{
  this->ExpectRefused({ "generate", "--mesh", (this->Data / "truth.ply").string(), "--views", "3",
                        "--size", "96x72", "--out", this->Data.string(), "--quiet" },
    "truth.ply: would be replaced");
}

TEST_F(Outputs, TimingsDoNotReplaceAPhotograph)
{
  this->ExpectRefused({ "check", this->Data.string(), "--quiet", "--timings",
                        (this->Data / "bunny0002.png").string() },
    "bunny0002.png: would be replaced");
}

TEST_F(Outputs, CheckDoesNotReplaceAPhotograph)
{
  fs::rename(this->Data / "bunny0000.png", this->Data / "cameras.png");
  fs::rename(this->Data / "mask/bunny0000.png", this->Data / "mask/cameras.png");
  WriteText(this->Data / "bunny_par.txt",
    Replaced(ReadText(this->Data / "bunny_par.txt"), "bunny0000", "cameras"));
  this->ExpectRefused({ "check", this->Data.string(), "--quiet", "--out", this->Data.string() },
    "cameras.png: would be replaced");
}

TEST_F(Outputs, RunDoesNotReplaceTheTruthOrTheTrueMesh)
{
  const fs::path out = this->Folder / "out";
  const std::vector<std::string> words = With(
    { "run", this->Data.string(), "--view", "between:0,1", "--out", out.string(), "--no-report" },
    Coarse);
  MustRun(words);
  this->ExpectRefused(
    With(words, { "--truth", (out / "novel.png").string() }), "novel.png: would be replaced");
  const std::string mesh = (this->Data / "truth.ply").string();
  this->ExpectRefused(
    With(words, { "--true-mesh", mesh, "--mesh-out", mesh }), "truth.ply: would be replaced");
}

TEST_F(Outputs, AJobRunsAgainInItsPlace)
{
  const fs::path out = this->Folder / "out";
  MustRun(With(
    { "run", this->Data.string(), "--view", "between:0,1", "--out", out.string(), "--no-report" },
    Coarse));
  const auto before = FilesBelow(out);
  MustRun({ "run", (out / "job.json").string(), "--quiet" });
  EXPECT_TRUE(FilesBelow(out) == before);
  this->ExpectRefused(
    { "run", (out / "job.json").string(), "--quiet", "--hull-spacing", "9" }, "job.json");
}

TEST_F(Outputs, MasksAreReplacedOnlyWhenAskedAndPhotographsNever)
{
  MustRun({ "mask", this->Data.string(), "--in-place", "--overwrite", "--quiet" });
  EXPECT_THAT(HalfWritten(this->Data), testing::IsEmpty());
  // A calibration may name a photograph as its own mask.
  const fs::path nerf = this->Folder / "nerf";
  MustRun({ "convert", this->Data.string(), nerf.string(), "--format", "nerf", "--quiet" });
  nlohmann::json transforms = ReadJson(nerf / "transforms.json");
  auto& frame = transforms["frames"][0];
  frame["mask_path"] = frame["file_path"];
  WriteText(nerf / "transforms.json", transforms.dump());
  this->ExpectRefused(
    { "mask", nerf.string(), "--in-place", "--overwrite", "--quiet" }, "would be replaced");
}

// ---- names from a calibration stay inside the out folder

TEST_F(Outputs, NamesOfViewsDoNotLeadOutOfTheFolderOfRender)
{
  const fs::path precious = this->Folder / "precious.png";
  fs::copy(this->Data / "bunny0000.png", precious);
  std::string views = ReadText(this->Data / "bunny_par.txt");
  views = Replaced(views, "bunny0000.png", precious.string());
  views = Replaced(views, "bunny0001.png", "../up.png");
  views = Replaced(views, "bunny0002.png", "plain");
  WriteText(this->Folder / "views_par.txt", views);
  const fs::path out = this->Folder / "a/out";
  MustRun(With({ "render", this->Data.string(), "--cameras",
                 (this->Folder / "views_par.txt").string(), "--out", out.string() },
    Coarse));
  EXPECT_TRUE(ReadText(precious) == ReadText(this->Data / "bunny0000.png"));
  EXPECT_FALSE(fs::exists(this->Folder / "a/up.png"));
  EXPECT_TRUE(fs::exists(out / "up.png"));
  EXPECT_TRUE(fs::exists(out / "mask/up.png"));
  EXPECT_TRUE(fs::exists(out / precious.relative_path()));
  EXPECT_TRUE(fs::exists(out / "plain.png")) << "a name without the extension of a picture";
}

TEST_F(Outputs, NamesOfViewsDoNotLeadOutOfTheFolderOfEvaluate)
{
  fs::create_directory(this->Folder / "up");
  fs::rename(this->Data / "bunny0000.png", this->Folder / "up/x.png");
  WriteText(this->Data / "bunny_par.txt",
    Replaced(ReadText(this->Data / "bunny_par.txt"), "bunny0000.png", "../up/x.png"));
  const fs::path out = this->Folder / "a/out";
  MustRun(With({ "evaluate", this->Data.string(), "--hold-out", "../up/x.png", "--out",
                 out.string(), "--no-report" },
    Coarse));
  EXPECT_FALSE(fs::exists(this->Folder / "a/up"));
  EXPECT_TRUE(fs::exists(out / "up/x.hull.png"));
}

// ---- whole or not at all

TEST_F(Outputs, AMeshThatDoesNotFitOnTheDiskIsAnError)
{
  for (const char* name : { "o.ply", "o.vtp", "o.stl", "o.glb", "o.obj" })
  {
    const fs::path file = this->Folder / name;
    const ProcessEnd end =
      RunLimited(1, With({ "mesh", this->Data.string(), "--out", file.string() }, Coarse));
    ExpectNotWritten(end, file.extension() == ".obj" ? this->Folder / "o.jpg" : file);
  }
}

TEST_F(Outputs, AMaskThatDoesNotFitOnTheDiskIsAnError)
{
  const ProcessEnd end = RunLimited(
    0, { "mask", this->Data.string(), "--out", (this->Folder / "out").string(), "--quiet" });
  ExpectNotWritten(end, this->Folder / "out/mask/bunny0000.png");
}

TEST_F(Outputs, AScreenshotThatDoesNotFitOnTheDiskIsAnError)
{
  const fs::path out = this->Folder / "out";
  const ProcessEnd end = RunLimited(40,
    { "run", this->Data.string(), "--view", "between:0,1", "--out", out.string(), "--quiet",
      "--no-depth-maps", "--hull-spacing", "8", "--outline-iterations", "1",
      "--non-outline-iterations", "0" });
  ExpectNotWritten(end, out / "iterations/outline_00_desktop.png");
}

TEST_F(Outputs, AFilmThatDoesNotFitOnTheDiskIsAnError)
{
  for (const char* name : { "film.avi", "film.mp4", "film.mov", "film.mkv" })
  {
    const fs::path film = this->Folder / name;
    const std::vector<std::string> words =
      With({ "orbit", this->Data.string(), "--out", film.string(), "--frames", "3" }, Coarse);
    MustRun(words);
    const auto size = static_cast<int>(fs::file_size(film));
    fs::remove(film);
    for (const int blocks : { 2, (size - 1) / 512 })
    {
      ExpectNotWritten(RunLimited(blocks, words), film);
    }
  }
}

TEST_F(Outputs, AFullStandardOutputIsAnError)
{
  const ProcessEnd end = RunShell(ShellQuoted(NOVELVIEW_PROGRAM) + " --help >/dev/full");
  EXPECT_EQ(end.Code, 1);
  EXPECT_THAT(end.Err, HasSubstr("novelview: error: standard output: cannot be written"));
  const ProcessEnd check = RunShell(
    ShellQuoted(NOVELVIEW_PROGRAM) + " check " + ShellQuoted(this->Data.string()) + " >/dev/full");
  EXPECT_EQ(check.Code, 1);
  EXPECT_THAT(check.Err, HasSubstr("standard output: cannot be written"));
}

TEST_F(Outputs, ClosedStreamsDoNotPutMessagesIntoFilms)
{
  std::string command = ShellQuoted(NOVELVIEW_PROGRAM) + " orbit " +
    ShellQuoted(this->Data.string()) +
    " --frames 3 --stage hull --no-depth-maps --hull-spacing 8 --out ";
  for (const char* kind : { ".avi", ".mp4" })
  {
    const fs::path open = this->Folder / (std::string("open") + kind);
    const fs::path closed = this->Folder / (std::string("closed") + kind);
    EXPECT_EQ(RunShell(command + ShellQuoted(open.string())).Code, 0);
    EXPECT_EQ(RunShell(command + ShellQuoted(closed.string()) + " --verbose <&- >&- 2>&-").Code, 0);
    EXPECT_EQ(ReadText(closed), ReadText(open)) << kind;
  }
}

TEST_F(Outputs, EverySignalThatEndsProgramsEndsARunInOrder)
{
  const fs::path out = this->Folder / "out";
  for (const auto& [name, code] :
    std::map<std::string, int>{ { "HUP", 129 }, { "INT", 130 }, { "TERM", 143 } })
  {
    const std::string first = ShellQuoted((out / "frame_0000.png").string());
    const ProcessEnd end =
      RunShell("rm -rf " + ShellQuoted(out.string()) + "; " + ShellQuoted(NOVELVIEW_PROGRAM) +
        " orbit " + ShellQuoted(this->Data.string()) + " --out " + ShellQuoted(out.string()) +
        " --frames 5000 --quiet --stage hull --no-depth-maps & program=$!\n" +
        "for i in $(seq 600); do [ -e " + first + " ] && break; sleep 0.1; done\n" + "kill -" +
        name + " $program; wait $program");
    EXPECT_EQ(end.Code, code) << name;
    EXPECT_EQ(end.Err, "novelview: error: interrupted\n") << name;
    EXPECT_THAT(HalfWritten(out), testing::IsEmpty()) << name;
  }
}

TEST_F(Outputs, OSMesaAndEglDrawTheSamePhotographs)
{
  const auto generated = [this](const char* renderer)
  {
    const fs::path out = this->Folder / renderer;
    const ProcessEnd end = RunShell(ShellQuoted(NOVELVIEW_PROGRAM) +
      " generate --mesh torus --texture marble --views 2 --size 160x120 --verbose --renderer " +
      std::string(renderer) + " --out " + ShellQuoted(out.string()));
    EXPECT_EQ(end.Code, 0) << end.Err;
    return std::pair(ReadText(out / "torus0001.png"), end.Out + end.Err);
  };
  const auto [osmesa, saidOfOSMesa] = generated("osmesa");
  const auto [egl, saidOfEgl] = generated("egl");
  EXPECT_THAT(saidOfOSMesa, HasSubstr("offscreen rendering with OSMesa: llvmpipe"));
  EXPECT_THAT(saidOfEgl, HasSubstr("offscreen rendering with EGL: llvmpipe"));
  EXPECT_TRUE(osmesa == egl) << "the same rasteriser makes other bits";
}
