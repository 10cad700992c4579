// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/ProgramRun.h"

#include "dataset/Dataset.h"
#include "formats/Middlebury.h"
#include "images/ImageFile.h"

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;

namespace
{
/** The picture at half the size: the means of four pixels each. */
Image<std::uint8_t> Halved(const Image<std::uint8_t>& image)
{
  Image<std::uint8_t> half(image.Width / 2, image.Height / 2, image.Channels);
  for (int y = 0; y < half.Height; ++y)
  {
    for (int x = 0; x < half.Width; ++x)
    {
      for (int c = 0; c < image.Channels; ++c)
      {
        const int sum = image(2 * x, 2 * y, c) + image(2 * x + 1, 2 * y, c) +
          image(2 * x, 2 * y + 1, c) + image(2 * x + 1, 2 * y + 1, c);
        half(x, y, c) = static_cast<std::uint8_t>((sum + 2) / 4);
      }
    }
  }
  return half;
}

/** A data set at half the size, which takes a quarter of the time. */
void WriteHalved(const fs::path& from, const fs::path& to)
{
  DatasetIndex index = ReadDatasetIndex(from);
  Eigen::Matrix3d halve = Eigen::Vector3d(0.5, 0.5, 1).asDiagonal();
  // Centre (0.5, 0.5) of the four top-left pixels becomes (0, 0).
  halve.topRightCorner<2, 1>().setConstant(-0.25);
  for (NamedCamera& camera : index.Cameras)
  {
    WriteImageFile(to / camera.Name, Halved(ReadColorFile(from / camera.Name)).Ref());
    WriteImageFile(
      to / "mask" / camera.Name, Halved(ReadGreyFile(from / "mask" / camera.Name)).Ref());
    camera.Cam.K = halve * camera.Cam.K;
  }
  WriteCameras(to / "half_par.txt", { index.Cameras.begin(), index.Cameras.end() });
}
}

TEST(RealPhotographs, TempleIsRefined)
{
  const fs::path temple = SharedFolder() / "data" / "templeSparseRing";
  if (!fs::exists(temple))
  {
    GTEST_SKIP() << "needs the Middlebury temple in " << temple;
  }
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  WriteHalved(temple, folder / "temple");
  MustRun({ "run", (folder / "temple").string(), "--quiet", "--view", "like:templeSR0004.png",
    "--no-iterations", "--out", out.string() });
  EXPECT_LT(ScoreIn(out, "full", "rms"), ScoreIn(out, "hull", "rms"));
  EXPECT_GT(ScoreIn(out, "full", "ssim"), ScoreIn(out, "hull", "ssim"));
  // The model must stand where the photograph has it; a wrong convention shows at once. Measured
  // 0.95 at the full size.
  EXPECT_GT(ScoreIn(out, "full", "iou"), 0.9);
}
