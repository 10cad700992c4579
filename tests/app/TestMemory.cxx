// SPDX-License-Identifier: GPL-3.0-or-later
// Too little memory is one line of error, wherever it runs out.
#include "support/ProgramRun.h"

using namespace novelview;
using namespace novelview::testing_support;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace
{
/** Runs the program with so much address space at most; a hang would end with 124. */
ProcessEnd RunWithin(int mebibytes, const std::vector<std::string>& words)
{
  std::string command = "ulimit -v " + std::to_string(mebibytes * 1024) + "; timeout 100 " +
    ShellQuoted(NOVELVIEW_PROGRAM);
  for (const std::string& word : words)
  {
    command += " " + ShellQuoted(word);
  }
  return RunShell(command);
}

class Memory : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    Bunny = std::make_unique<GeneratedData>(
      std::vector<std::string>{ "--views", "6", "--step", "60", "--size", "96x72" });
    // What the libraries take before main() begins. With less the loader says so, and ends with 127.
    while (MinMiB < 2000 && RunWithin(MinMiB, { "--version" }).Code != 0)
    {
      MinMiB += 20;
    }
  }
  static void TearDownTestSuite() { Bunny.reset(); }

  /** Expects success or one line of error with all limits up to this many MiB above the least. */
  static void ExpectOneLine(int range, int step, const std::vector<std::string>& words)
  {
    int failed = 0;
    for (int mebibytes = MinMiB; mebibytes <= MinMiB + range; mebibytes += step)
    {
      const ProcessEnd end = RunWithin(mebibytes, words);
      if (end.Code == 0)
      {
        EXPECT_EQ(end.Err, "") << mebibytes;
        continue;
      }
      ++failed;
      EXPECT_EQ(end.Code, 1) << mebibytes << ": " << end.Err;
      EXPECT_THAT(end.Err, testing::StartsWith("novelview: error: ")) << mebibytes;
      EXPECT_THAT(end.Err, HasSubstr("out of memory")) << mebibytes;
      EXPECT_EQ(std::count(end.Err.begin(), end.Err.end(), '\n'), 1) << mebibytes << end.Err;
    }
    EXPECT_GT(failed, 1) << "or the limits limit nothing";
  }

  static inline std::unique_ptr<GeneratedData> Bunny;
  static inline int MinMiB = 300;
};
}

TEST_F(Memory, OomHangIsOneLineOfError)
{
  ExpectOneLine(700, 50,
    { "run", Bunny->Data().string(), "--view", "between:0,1", "--quiet", "--stage", "outline",
      "--outline-iterations", "1", "--out", (Bunny->Folder / "out").string() });
}

TEST_F(Memory, OfVideosIsOneLineOfErrorToo)
{
  // Libraries are silenced while they encode; the error must be printed nevertheless.
  ExpectOneLine(180, 15,
    { "orbit", Bunny->Data().string(), "--frames", "3", "--quiet", "--stage", "hull", "--out",
      (Bunny->Folder / "film.mp4").string() });
}
