// SPDX-License-Identifier: GPL-3.0-or-later
// Too little memory is one line of error, whoever runs out of it.
#include "ProgramRun.h"

using namespace novelview;
using namespace novelview::testing_support;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace
{
/** Runs the program with so much address space at most; a hang would end with 124. */
ProcessEnd RunWithin(int mebibytes, const std::vector<std::string>& words)
{
  std::string command =
    "ulimit -v " + std::to_string(mebibytes * 1024) + "; timeout 100 " + Quoted(NOVELVIEW_PROGRAM);
  for (const std::string& word : words)
  {
    command += " " + Quoted(word);
  }
  return RunShell(command);
}
}

TEST(Memory, OomHangIsOneLineOfError)
{
  const GeneratedData bunny({ "--views", "6", "--step", "60", "--size", "96x72" });
  // What the libraries take before main() begins. With less the loader says so, and ends with 127.
  int least = 300;
  while (least < 2000 && RunWithin(least, { "--version" }).Code != 0)
  {
    least += 20;
  }
  int failed = 0;
  for (int mebibytes = least; mebibytes <= least + 700; mebibytes += 50)
  {
    const ProcessEnd end = RunWithin(mebibytes,
      { "run", bunny.Data().string(), "--view", "between:0,1", "--quiet", "--stage", "outline",
        "--outline-iterations", "1", "--out", (bunny.Folder / "out").string() });
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
  EXPECT_GT(failed, 3) << "or the limits limit nothing";
}
