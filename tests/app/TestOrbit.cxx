// SPDX-License-Identifier: GPL-3.0-or-later
// `novelview orbit`, by the built program.
#include "support/ProgramRun.h"

#include "formats/Middlebury.h"

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;
using testing::HasSubstr;

namespace
{
/** A small bunny; the held-out views are the frames of a slow video. */
class Orbit : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    Bunny = std::make_unique<GeneratedData>(std::vector<std::string>{
      "--size", "160x120", "--test-angles", "10,10.5,11,11.5,12,12.5,13,13.5,14,14.5,15,15.5,16" });
  }
  static void TearDownTestSuite() { Bunny.reset(); }

  static fs::path Out(const std::string& out) { return Bunny->Folder / out; }
  static std::vector<std::string> Words(
    const std::string& command, const std::string& out, const std::vector<std::string>& more)
  {
    return With({ command, Bunny->Data().string(), "--quiet", "--out", Out(out).string(), "--cache",
                  Out("cache").string() },
      more);
  }

  static inline std::unique_ptr<GeneratedData> Bunny;
};
}

TEST_F(Orbit, FilmsOnceRoundTheCamerasRing)
{
  const fs::path frames = Out("frames");
  MustRun(Words(
    "orbit", "film.mp4", { "--frames", "6", "--frames-dir", frames.string(), "--stage", "hull" }));
  // Through OpenCV of the yardstick's package, a reader of its own.
  const ProcessEnd read =
    RunShell("/usr/bin/python3 -c \"import cv2; v = cv2.VideoCapture('" + Out("film.mp4").string() +
      "'); n = 0\nwhile v.grab(): n += 1\nprint(n, int(v.get(3)), int(v.get(4)), v.get(5))\"");
  EXPECT_EQ(read.Out, "6 160 120 24.0\n") << read.Err;
  const auto cameras = ReadCameras(frames / "frames_par.txt");
  const auto photographs = ReadCameras(Bunny->Data() / "bunny_par.txt");
  ASSERT_EQ(cameras.size(), 6u);
  for (int i = 0; i < 6; ++i)
  {
    // Every second photograph's camera, numbers of a few units, rounded to 2^-26 (CameraGrid).
    EXPECT_LT((cameras[i].Cam.Centre() - photographs[2 * i].Cam.Centre()).norm(), 1e-7) << i;
    EXPECT_LT((cameras[i].Cam.R - photographs[2 * i].Cam.R).cwiseAbs().maxCoeff(), 1e-7) << i;
  }
  EXPECT_TRUE(HalfWritten(Out("")).empty());
  // A frame is what `render` gives with a video's options, and a folder gets the same frames.
  MustRun(Words("render", "rendered",
    { "--cameras", (frames / "frames_par.txt").string(), "--stage", "hull", "--soft-boundary",
      "--boundary-samples", "5" }));
  fs::remove(frames / "frames_par.txt");
  ExpectSameFiles(frames, Out("rendered"));
  MustRun(Words("orbit", "folder", { "--frames", "6", "--stage", "hull" }));
  fs::remove(Out("folder") / "frames_par.txt");
  ExpectSameFiles(frames, Out("folder"));
}

TEST_F(Orbit, GoesThroughKeyCamerasFromAJobFile)
{
  WriteText(Out("path.json"), R"({ "size": "80x60", "keys": [
    { "frame": 0, "camera": "bunny0000.png", "fieldOfView": 30 },
    { "frame": 2, "camera": 1, "fieldOfView": 30 } ] })");
  WriteText(Out("job.json"), R"({ "dataset": "data", "out": "keys.avi", "path": "path.json",
    "stage": "hull", "framesDir": "keys" })");
  MustRun({ "orbit", Out("job.json").string(), "--quiet" });
  EXPECT_TRUE(fs::exists(Out("keys.avi")));
  const auto cameras = ReadCameras(Out("keys") / "frames_par.txt");
  ASSERT_EQ(cameras.size(), 3u);
  EXPECT_TRUE(fs::exists(Out("keys") / "mask" / "frame_0002.png"));
}

TEST_F(Orbit, IsSteadyFromFrameToFrame)
{
  MustRun(Words("render", "slow",
    { "--cameras", (Bunny->Data() / "test/test_par.txt").string(), "--soft-boundary",
      "--boundary-samples", "5" }));
  const fs::path script = fs::path(NOVELVIEW_SOURCE_DIR) / "tests" / "steadiness.py";
  const auto measure = [&](const fs::path& film)
  {
    const ProcessEnd end = RunShell("/usr/bin/python3 " + ShellQuoted(script.string()) + " " +
      ShellQuoted(film.string()) + " " + ShellQuoted((Bunny->Data() / "test").string()));
    if (end.Code != 0)
    {
      throw Error("steadiness.py", end.Err);
    }
    return nlohmann::json::parse(end.Out);
  };
  const nlohmann::json slow = measure(Out("slow"));
  RecordProperty("steadiness", slow.dump());
  const auto ratio = [&slow](const char* part)
  { return slow.at(part).at("film").get<double>() / slow.at(part).at("truth").get<double>(); };
  // The measure itself: the truth, which is the same video twice, except for its softer boundary.
  EXPECT_LT(measure(Bunny->Data() / "test").at("rms").get<double>(), 3);
  // Inside there is no more flicker than in the truth: no seams between photographs that jump.
  EXPECT_LT(ratio("inside"), 1.05) << slow;
  // At the boundary the contour, known to a fraction of a pixel, moves a little to and fro. With
  // pixels of less than half coverage left black the ratio would be above 3.
  EXPECT_LT(ratio("rim"), 2.2) << slow;
  // Of the silhouette's area it is hardly more than counting pixels gives with the truth.
  EXPECT_LT(ratio("area"), 2) << slow;
}

#ifdef NOVELVIEW_VIDEOIO
TEST_F(Orbit, OnlyAFilmNeedsTheVideoLibraries)
{
  fs::create_directories(Out("broken"));
  // An empty file instead of OpenCV's videoio: loading it fails.
  WriteText(Out("broken") / NOVELVIEW_VIDEOIO, "");
  const auto run = [&](const std::string& out)
  {
    return RunShell("LD_LIBRARY_PATH=" + ShellQuoted(Out("broken").string()) +
      "${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} " + ShellQuoted(NOVELVIEW_PROGRAM) + " orbit " +
      ShellQuoted(Bunny->Data().string()) + " --frames 2 --stage hull --quiet --out " +
      ShellQuoted(Out(out).string()));
  };
  const ProcessEnd folder = run("without");
  EXPECT_EQ(folder.Code, 0) << folder.Err;
  EXPECT_TRUE(fs::exists(Out("without") / "frame_0001.png"));
  const ProcessEnd film = run("without.mp4");
  EXPECT_EQ(film.Code, 1);
  EXPECT_THAT(film.Err, HasSubstr("the library that writes videos cannot be loaded"));
  EXPECT_THAT(film.Err, HasSubstr(NOVELVIEW_VIDEOIO));
  EXPECT_EQ(std::count(film.Err.begin(), film.Err.end(), '\n'), 1) << film.Err;
  EXPECT_FALSE(fs::exists(Out("without.mp4")));
}
#endif

TEST_F(Orbit, BadUsageLeavesNothing)
{
  const auto expect =
    [](const std::string& out, const std::vector<std::string>& more, const std::string& part)
  {
    const ProcessEnd end = RunProgram(Words("orbit", out, more));
    EXPECT_EQ(end.Code, 2);
    EXPECT_THAT(end.Err, HasSubstr(part));
    EXPECT_EQ(std::count(end.Err.begin(), end.Err.end(), '\n'), 1) << end.Err;
    EXPECT_FALSE(fs::exists(Out(out)));
  };
  expect("bad.gif", {}, "--out: is not a video that can be written (got bad.gif, expected .avi");
  expect("bad.mp4", { "--exclude", "bunny0000.png,bunny0001.png,bunny0002.png,bunny0003.png" },
    "use --path to define");
  expect("bad.mp4", { "--path", Out("nowhere.json").string() }, "no such file");
}
