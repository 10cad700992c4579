// SPDX-License-Identifier: GPL-3.0-or-later
// Calibrations of other programs: those that are read, and those that are named.
#include "formats/NumpyArrays.h"
#include "formats/ProjectionMatrix.h"
#include "images/ImageFile.h"
#include "support/CalibrationCases.h"

#include <algorithm>

using namespace novelview;
using namespace novelview::testing_support;

namespace
{
/** Photographs without folders, of which the formats know neither size nor name. */
std::vector<Photograph> Flat()
{
  std::vector<Photograph> photographs = RandomPhotographs(5, false, {});
  for (std::size_t i = 0; i < photographs.size(); ++i)
  {
    photographs[i].Name = "view" + std::to_string(i + 8) + ".png"; // view10 is behind view9
  }
  return photographs;
}

void WritePhotographs(const std::filesystem::path& folder, const std::vector<Photograph>& of)
{
  for (const Photograph& photograph : of)
  {
    WriteFile(folder / photograph.Name, "");
  }
}
}

TEST(ForeignFormats, CamerasOfNeusAreRead)
{
  const TemporaryFolder folder;
  const std::vector<Photograph> photographs = Flat();
  WriteCalibration(folder.Path, "neus", photographs);
  WritePhotographs(folder / "image", photographs);
  WriteFile(folder / "mask/view8.png", "");
  const DatasetIndex index = ReadDatasetIndex(folder.Path);
  EXPECT_EQ(index.Format, "neus");
  ExpectSamePhotographs(index.Cameras, photographs, 1e-9);
  EXPECT_EQ(index.Cameras[0].File, folder / "image/view8.png");
  EXPECT_EQ(index.Cameras[0].Mask, folder / "mask/view8.png");
  std::filesystem::remove(folder / "image/view9.png");
  ExpectError([&] { ReadDatasetIndex(folder.Path); }, "cameras_sphere.npz",
    "another number of cameras than there are photographs", "got 6, expected 5");
}

TEST(ForeignFormats, ProjectionsOfAnyScaleAndSignHaveTheSameCamera)
{
  const Camera camera = RandomPhotographs(6, false, {}, 3.0).front().Cam;
  ProjectionMatrix P;
  P << camera.K * camera.R, camera.K * camera.T;
  for (const double scale : { 1.0, -0.01, 250.0 })
  {
    Camera read;
    SetFromProjection(scale * P, "P", read);
    EXPECT_LT((read.K - camera.K).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((read.R - camera.R).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((read.T - camera.T).cwiseAbs().maxCoeff(), 1e-9);
  }
  Camera none;
  ExpectError([&] { SetFromProjection(ProjectionMatrix::Zero(), "P", none); }, "P",
    "no projection of a camera");
}

TEST(ForeignFormats, ArraysThatNumpySavedAreRead)
{
  const TemporaryFolder folder;
  const std::vector<Photograph> photographs = Flat();
  NumpyArray K{ { photographs.size(), 3, 3 }, {} };
  NumpyArray R = K;
  NumpyArray t{ { photographs.size(), 3, 1 }, {} };
  for (const Photograph& photograph : photographs)
  {
    for (int i = 0; i < 9; ++i)
    {
      K.Values.push_back(photograph.Cam.K(i / 3, i % 3));
      R.Values.push_back(photograph.Cam.R(i / 3, i % 3));
    }
    t.Values.insert(t.Values.end(), photograph.Cam.T.data(), photograph.Cam.T.data() + 3);
  }
  WriteFile(folder / "calibration.npz", ComposeNpz({ { "K", K }, { "R", R }, { "t", t } }));
  WritePhotographs(folder.Path, photographs);
  ExpectSamePhotographs(ReadDatasetIndex(folder.Path).Cameras, photographs, 0);
  WriteFile(folder / "calibration.npz", ComposeNpz({ { "K", K }, { "poses", R } }));
  ExpectError([&] { ReadDatasetIndex(folder.Path); }, "calibration.npz", "has no array R",
    "got K, poses", "expected K, R and t");
}

TEST(ForeignFormats, DamagedNumpyFilesAreErrors)
{
  const TemporaryFolder folder;
  const std::string whole = ComposeNpz({ { "world_mat_0", { { 2 }, { 1, 2 } } } });
  for (std::size_t length = 0; length < whole.size(); ++length)
  {
    WriteFile(folder / "a.npz", whole.substr(0, length));
    EXPECT_THROW(ReadNpz(folder / "a.npz"), Error) << length;
  }
  std::string changed = whole;
  changed[140] ^= 1;
  WriteFile(folder / "a.npz", changed);
  ExpectError([&] { ReadNpz(folder / "a.npz"); }, "world_mat_0.npy", "checksum");
}

TEST(ForeignFormats, PosesOfLlffAreReadForPhotographsOfAnotherSize)
{
  const TemporaryFolder folder;
  // One camera at (1, 2, 3) with the world's axes, for 400 x 200 and focal length 300.
  const std::vector<double> pose{ 0, 1, 0, 1, 200, 1, 0, 0, 2, 400, 0, 0, -1, 3, 300, 1, 9 };
  const std::string npz = ComposeNpz({ { "a", { { 1, 17 }, pose } } });
  const std::size_t begin = npz.find("\x93NUMPY");
  WriteFile(folder / "poses_bounds.npy", npz.substr(begin, npz.find("PK\x01\x02") - begin));
  WriteImageFile(folder / "images/a.png", Image<std::uint8_t>(200, 100, 3, 0).Ref());
  const DatasetIndex index = ReadDatasetIndex(folder.Path);
  EXPECT_EQ(index.Format, "llff");
  const Camera& camera = index.Cameras.at(0).Cam;
  EXPECT_TRUE(camera.R.isApprox(Eigen::Matrix3d::Identity()));
  EXPECT_TRUE(camera.T.isApprox(Eigen::Vector3d(-1, -2, -3)));
  EXPECT_DOUBLE_EQ(camera.K(0, 0), 150);
  EXPECT_DOUBLE_EQ(camera.K(0, 2), 99.5);
}

TEST(ForeignFormats, CamerasOfMvsNetAreRead)
{
  const TemporaryFolder folder;
  const std::vector<Photograph> photographs = Flat();
  WriteCalibration(folder.Path, "mvsnet", photographs);
  WritePhotographs(folder / "images", photographs);
  DatasetIndex index = ReadDatasetIndex(folder.Path);
  EXPECT_EQ(index.Format, "mvsnet");
  std::sort(index.Cameras.begin(), index.Cameras.end(),
    [](const auto& a, const auto& b) { return NaturallyBefore(a.Name, b.Name); });
  ExpectSamePhotographs(index.Cameras, photographs, 1e-12);
  WriteFile(folder / "cams/view8_cam.txt", "extrinsic\n1 0 0");
  ExpectError([&] { ReadDatasetIndex(folder.Path); }, "view8_cam.txt", "behind \"extrinsic\"");
}

TEST(ForeignFormats, CalibrationsThatAreNotReadAreNamedWithTheWayOut)
{
  const std::vector<std::vector<std::string>> cases{ { "cameras.sfm", "{}",
                                                       "aliceVision_exportColmap" },
    { "sfm_data.json", "{}", "openMVG2Colmap" },
    { "cams.xml", "<?xml?><document><chunk>", "Metashape" },
    { "bundle.out", "# Bundle file v0.3", "Bundler" }, { "walk.mp4", "", "ffmpeg" },
    { "IMG_1.HEIC", "", "heif-convert" }, { "a.CR2", "", "raw photographs" } };
  for (const std::vector<std::string>& each : cases)
  {
    const TemporaryFolder folder;
    WriteFile(folder / each[0], each[1]);
    ExpectError([&] { ReadDatasetIndex(folder.Path); }, folder.Path.string(), each[0], each[2]);
    ExpectError([&] { ReadDatasetIndex(folder / each[0]); }, each[0]);
  }
}
