// SPDX-License-Identifier: GPL-3.0-or-later
// The photograph of --view like:IMAGE is used nowhere but in the scores.
#include "support/ProgramRun.h"

#include "images/ImageFile.h"

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;

namespace
{
/** Replaces a picture by others pixels of the same size. */
void Spoil(const fs::path& file, int channels)
{
  const PictureSize size = ReadPictureSize(file);
  Image<std::uint8_t> garbage(size.Width, size.Height, channels);
  unsigned int state = 1;
  for (std::uint8_t& value : garbage.Values)
  {
    state = state * 1664525u + 1013904223u; // Numerical Recipes' generator
    value = static_cast<std::uint8_t>(state >> 24);
  }
  WriteImageFile(file, garbage.Ref());
}
}

TEST(HeldOut, PhotographChangesTheScoresAndNothingElse)
{
  const GeneratedData bunny({ "--views", "8", "--step", "45", "--size", "160x120" });
  const fs::path data = bunny.Data();
  const auto run = [&](const std::string& out)
  {
    MustRun({ "run", data.string(), "--quiet", "--view", "like:bunny0003.png", "--no-screenshots",
      "--outline-iterations", "3", "--non-outline-iterations", "3", "--out",
      (bunny.Folder / out).string() });
    return FilesBelow(bunny.Folder / out);
  };
  const auto whole = run("whole");
  Spoil(data / "bunny0003.png", 3);
  Spoil(data / "mask" / "bunny0003.png", 1);
  const auto spoilt = run("spoilt");

  // What is allowed to depend on the truth: the truth, the scores and the pictures of them, and the
  // page that shows these.
  std::vector<std::string> differing;
  for (const auto& [name, content] : whole)
  {
    ASSERT_TRUE(spoilt.contains(name)) << name;
    if (content != spoilt.at(name))
    {
      differing.push_back(name);
    }
  }
  EXPECT_THAT(differing,
    testing::UnorderedElementsAre("truth.png", "summary.json", "rms.png", "rms_outline.csv",
      "rms_nonoutline.csv", "stages/hull_error.png", "stages/outline_error.png",
      "stages/full_error.png", "report.html"));
  const double rms = ScoreIn(bunny.Folder / "whole", "full", "rms");
  // Noise has nothing of the bunny: its error is far above the geometry's.
  EXPECT_GT(ScoreIn(bunny.Folder / "spoilt", "full", "rms"), 2 * rms);
}
