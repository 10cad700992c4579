// SPDX-License-Identifier: GPL-3.0-or-later
// The texture mapper on the true mesh against an independent program that does the same.
#include "support/ProgramRun.h"

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;

TEST(Oracle, IsAtLeastAsGoodAsTheYardstick)
{
  const fs::path script = SharedFolder() / "yardstick" / "judge_mesh.py";
  if (!fs::exists(script) ||
    RunShell("command -v xvfb-run && /usr/bin/python3 -c 'import cv2, numpy, skimage, vtk'").Code !=
      0)
  {
    GTEST_SKIP() << "needs " << script
                 << ", xvfb-run and python3 with OpenCV, scikit-image and VTK";
  }
  const GeneratedData bunny({ "--size", "320x240" });
  const fs::path mesh = bunny.Data() / "truth.ply";
  const fs::path out = bunny.Folder / "run";
  // The hull is all that is needed beside the oracle.
  MustRun({ "run", bunny.Data().string(), "--quiet", "--view", bunny.HeldOut(), "--stage", "hull",
    "--no-iterations", "--true-mesh", mesh.string(), "--out", out.string() });
  const ProcessEnd judged =
    RunShell("xvfb-run -a /usr/bin/python3 " + ShellQuoted(script.string()) + " " +
      ShellQuoted(mesh.string()) + " " + ShellQuoted(bunny.Data().string()) + " " +
      ShellQuoted((bunny.Data() / "test" / "test_par.txt").string()) + " " +
      ShellQuoted((bunny.Folder / "judged").string()));
  ASSERT_EQ(judged.Code, 0) << judged.Err;
  std::map<std::string, double> yardstick;
  std::istringstream words(judged.Out.substr(judged.Out.find("mean ") + 5));
  std::string key;
  for (double value; words >> key >> value;)
  {
    yardstick[key] = value;
  }
  ASSERT_TRUE(yardstick.contains("rms") && yardstick.contains("ssim")) << judged.Out;
  // The script prints four decimals.
  EXPECT_LE(ScoreIn(out, "oracle", "rms"), yardstick["rms"] + 1e-4);
  EXPECT_GE(ScoreIn(out, "oracle", "ssim"), yardstick["ssim"] - 1e-4);
}
