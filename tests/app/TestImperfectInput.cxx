// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's dinosaur: a plain object, partly out of frame, a shadow on it in one photograph.
#include "support/ProgramRun.h"

#include "images/ImageFile.h"

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;

namespace
{
class Dinosaur : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    // Every third photograph cuts the object; in photograph 4, which does not, half of it lies in a
    // shadow that simple thresholding takes for background.
    Data = std::make_unique<GeneratedData>(std::vector<std::string>{ "--texture", "grey", "--size",
      "320x240", "--frame-shift", "0.3", "--shadow-views", "4", "--masks", "threshold" });
  }
  static void TearDownTestSuite() { Data.reset(); }

  /** Runs with these options more, expects success, and returns what was said. */
  static std::string Run(const std::string& out, const std::vector<std::string>& more)
  {
    const ProcessEnd end =
      RunProgram(With({ "run", Data->Data().string(), "--quiet", "--view", Data->HeldOut(),
                        "--no-iterations", "--out", (Data->Folder / out).string() },
        more));
    EXPECT_EQ(end.Code, 0) << end.Err;
    return end.Err;
  }

  static inline std::unique_ptr<GeneratedData> Data;
};
}

TEST_F(Dinosaur, OwnSilhouettesFindTheWholeObject)
{
  const std::string said = Run("own", { "--force-silhouettes" });
  EXPECT_LE(
    ScoreIn(Data->Folder / "own", "full", "rms"), ScoreIn(Data->Folder / "own", "hull", "rms"));
  EXPECT_THAT(said, testing::HasSubstr("leaves the frame"));
  // A silhouette wrong by one pixel all around costs about 4 % at this size; the rest is the hull's.
  EXPECT_GT(ScoreIn(Data->Folder / "own", "full", "iou"), 0.96);
}

TEST_F(Dinosaur, BrokenMaskCutsTheObjectUntilItsPhotographIsLeftOut)
{
  Run("threshold", {});
  Run("without", { "--exclude", "bunny0004.png" });
  const fs::path threshold = Data->Folder / "threshold";
  const fs::path without = Data->Folder / "without";
  // Masks that are given are believed: what the shadow takes from one mask is carved away in all
  // views (measured 0.86 of the object left), but no more than that.
  EXPECT_GT(ScoreIn(threshold, "full", "iou"), 0.75);
  // What is missing in the model cannot be refined, but what is left must not fall apart: the part
  // that is missing is most of the error, so a twentieth of it is much for the rest.
  EXPECT_LE(ScoreIn(threshold, "full", "rms"), 1.05 * ScoreIn(threshold, "hull", "rms"));
  EXPECT_GT(ScoreIn(threshold, "full", "ssim"), ScoreIn(threshold, "hull", "ssim"));
  // Eleven photographs are nearly as good as twelve.
  EXPECT_GT(ScoreIn(without, "full", "iou"), 0.96);
  EXPECT_LE(ScoreIn(without, "full", "rms"), ScoreIn(without, "hull", "rms"));
}
