// SPDX-License-Identifier: GPL-3.0-or-later
// Several processes: `mpirun -n N novelview ..` leaves what one process does, or an error.
#ifdef NOVELVIEW_MPIEXEC
#include "support/ProgramRun.h"

#include "formats/Middlebury.h"

#include <chrono>

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;
using testing::HasSubstr;

namespace
{
class Processes : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    Bunny = std::make_unique<GeneratedData>(std::vector<std::string>{
      "--views", "8", "--step", "45", "--size", "96x72", "--test-angles", "15,70,130,200,300" });
  }
  static void TearDownTestSuite() { Bunny.reset(); }

  static fs::path Out(const std::string& out) { return Bunny->Folder / out; }
  static std::string Cameras() { return (Bunny->Data() / "test" / "test_par.txt").string(); }

  /** The words of a command on the bunny. */
  static std::vector<std::string> Words(
    const std::string& command, const std::string& out, const std::vector<std::string>& more)
  {
    return With({ command, Bunny->Data().string(), "--out", Out(out).string() }, more);
  }

  /** Runs the program in this many processes; `before` is what the shell of each does first. */
  static ProcessEnd RunIn(
    int processes, const std::vector<std::string>& words, const std::string& before = "")
  {
    std::string command = ShellQuoted(NOVELVIEW_PROGRAM);
    for (const std::string& word : words)
    {
      command += " " + ShellQuoted(word);
    }
    const TemporaryFolder folder;
    WriteText(folder / "each.sh", before + "\nexec " + command + "\n");
    // A hang would be ended by timeout, with 124.
    return RunShell("timeout 100 " NOVELVIEW_MPIEXEC
                    " --allow-run-as-root --oversubscribe --bind-to none -n " +
      std::to_string(processes) + " sh " + ShellQuoted((folder / "each.sh").string()));
  }

  static long LinesWith(const std::string& text, const std::string& part)
  {
    std::istringstream lines(text);
    long count = 0;
    for (std::string line; std::getline(lines, line);)
    {
      count += line.find(part) != std::string::npos;
    }
    return count;
  }

  /** Expects a run of several processes to fail with one error line. */
  static void ExpectOneError(const ProcessEnd& end, int code, const std::string& part)
  {
    EXPECT_EQ(end.Code, code) << end.Err;
    EXPECT_EQ(LinesWith(end.Err, "novelview: error: "), 1) << end.Err;
    EXPECT_THAT(end.Err, HasSubstr(part));
  }

  static inline std::unique_ptr<GeneratedData> Bunny;
};
}

TEST_F(Processes, RenderTheSameFiles)
{
  MustRun(Words("render", "one", { "--cameras", Cameras(), "--quiet" }));
  for (const int processes : { 2, 4 })
  {
    const std::string out = "many" + std::to_string(processes);
    const ProcessEnd end = RunIn(processes,
      Words("render", out, { "--cameras", Cameras(), "--timings", Out(out + ".json").string() }));
    ASSERT_EQ(end.Code, 0) << end.Err;
    ExpectSameFiles(Out("one"), Out(out));
    // The first process reports every view once, in order, including the work of the others.
    EXPECT_EQ(LinesWith(end.Out, "/test000"), 5) << end.Out;
    EXPECT_LT(end.Out.find("/test0003.png"), end.Out.find("/test0004.png"));
    EXPECT_EQ(LinesWith(end.Out, "culling done"), 5) << end.Out;
    EXPECT_EQ(LinesWith(end.Out, "visual hull done"), 1) << end.Out;
    EXPECT_TRUE(ReadJson(Out(out + ".json")).at("stages").contains("non-outline"));
  }
}

TEST_F(Processes, FilmTheSameVideo)
{
  const std::vector<std::string> options = { "--frames", "5", "--stage", "outline", "--quiet" };
  const auto film = [&](const std::string& name) {
    return Words("orbit", name + ".mp4", With(options, { "--frames-dir", Out(name).string() }));
  };
  MustRun(film("alone"));
  const ProcessEnd end = RunIn(3, film("together"));
  ASSERT_EQ(end.Code, 0) << end.Err;
  ExpectSameFiles(Out("alone"), Out("together"));
  EXPECT_TRUE(ReadText(Out("alone.mp4")) == ReadText(Out("together.mp4")));
  EXPECT_TRUE(HalfWritten(Bunny->Folder.Path).empty());
}

TEST_F(Processes, ScoreTheSame)
{
  for (const std::string way : { "--leave-one-out", "--pictures" })
  {
    const std::vector<std::string> options = { "--stage", "hull", "--quiet", way };
    MustRun(Words("evaluate", "scores1" + way, options));
    const ProcessEnd end = RunIn(4, Words("evaluate", "scores4" + way, options));
    ASSERT_EQ(end.Code, 0) << end.Err;
    ExpectSameFiles(Out("scores1" + way), Out("scores4" + way));
  }
}

TEST_F(Processes, AFailingViewIsOneError)
{
  auto cameras = ReadCameras(Cameras());
  for (NamedCamera& camera : cameras)
  {
    camera.Cam.T.z() *= 1000; // so far away that the object covers no pixel
  }
  cameras[0] = ReadCameras(Cameras())[0];
  WriteCameras(Out("far_par.txt"), cameras);
  ExpectOneError(RunIn(3,
                   Words("render", "far",
                     { "--cameras", Out("far_par.txt").string(), "--stage", "hull", "--quiet" })),
    1, "too far away");
  EXPECT_TRUE(HalfWritten(Out("far")).empty());
}

TEST_F(Processes, ADeadProcessIsAnErrorAndNoHang)
{
  for (const std::string rank : { "0", "2" })
  {
    // The shell becomes the program, so its number stays.
    const std::string killed =
      "if [ $OMPI_COMM_WORLD_RANK = " + rank + " ]; then (sleep 2; kill -9 $$) & fi";
    const auto start = std::chrono::steady_clock::now();
    const ProcessEnd end = RunIn(
      3, Words("orbit", "dead.mp4", { "--frames", "5000", "--stage", "hull", "--quiet" }), killed);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    EXPECT_NE(end.Code, 0);
    EXPECT_NE(end.Code, 124);
    // Killed after 2 s; the rest is mpirun's to notice and end the others.
    EXPECT_LT(taken.count(), 60);
    EXPECT_FALSE(fs::exists(Out("dead.mp4")));
  }
}

TEST_F(Processes, AStoppedProcessEndsTheRun)
{
  for (const std::string rank : { "0", "2" })
  {
    // It stops once the first frame shows that all of them work, and never goes on by itself.
    const fs::path frames = Out("stopped" + rank);
    const std::string stopped = "if [ $OMPI_COMM_WORLD_RANK = " + rank +
      " ]; then (for i in $(seq 900); do ls " + ShellQuoted(frames.string()) +
      "/*0000.png && break; sleep 0.1; done; kill -STOP $$) >/dev/null 2>&1 & fi";
    ProcessEnd end = RunIn(3,
      Words("orbit", "stopped.mp4",
        { "--frames", "5000", "--stage", "hull", "--quiet", "--frames-dir", frames.string(),
          "--rank-timeout", "2" }),
      stopped);
    // mpirun wakes the stopped one with SIGTERM, which the first process heeds in order.
    const std::string woken = "novelview: error: interrupted\n";
    if (const std::size_t at = end.Err.find(woken); rank == "0" && at != std::string::npos)
    {
      end.Err.erase(at, woken.size());
    }
    ExpectOneError(end, 1, "process " + rank + " of mpirun: silent for ");
    EXPECT_FALSE(fs::exists(Out("stopped.mp4")));
  }
}

TEST_F(Processes, ALongStageIsNoSilence)
{
  // A picture of these takes longer than the silence that is allowed, and hull and crust do, too.
  const ProcessEnd end = RunIn(2,
    Words("render", "slow",
      { "--cameras", Cameras(), "--quiet", "--hull-spacing", "0.25", "--rank-timeout", "1" }));
  EXPECT_EQ(end.Code, 0) << end.Err;
}

TEST_F(Processes, SlipsAreToldOnce)
{
  ExpectOneError(RunIn(2, Words("run", "bad", { "--view", "between:0,1" })), 2,
    "run: cannot be shared between processes (got 2 processes");
  ExpectOneError(RunIn(2, Words("render", "bad", {})), 2, "--cameras");
  ExpectOneError(RunIn(2, Words("orbit", "bad.gif", {})), 2, "is not a video");
  ExpectOneError(
    RunIn(2, { "orbit", Out("nowhere").string(), "--out", Out("bad").string() }), 1, "nowhere");
  const ProcessEnd help = RunIn(2, { "--version" });
  EXPECT_EQ(help.Code, 0);
  EXPECT_EQ(LinesWith(help.Out, "novelview "), 1) << help.Out;
}
#endif
