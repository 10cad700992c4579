// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/Middlebury.h"
#include "images/ImageFile.h"
#include "support/TestSupport.h"
#include "video/CameraTrajectory.h"

using namespace novelview;
using namespace novelview::testing_support;
using Eigen::Vector3d;

namespace
{
/** Eight cameras on a ring of radius 4, height 1, with photographs of 32x24. */
class CameraTrajectoryTest : public testing::Test
{
protected:
  static Camera OnRing(double angleDeg)
  {
    const double a = angleDeg * EIGEN_PI / 180;
    Eigen::Matrix3d k;
    k << 40, 0, 15.5, 0, 40, 11.5, 0, 0, 1;
    return LookAt(Vector3d(4 * std::sin(a), 1, 4 * std::cos(a)), Vector3d::Zero(),
      Vector3d::UnitY(), k, 32, 24);
  }

  CameraTrajectoryTest()
  {
    std::vector<NamedCamera> cameras;
    for (int i = 0; i < 8; ++i)
    {
      cameras.push_back({ "v" + std::to_string(i) + ".png", OnRing(45 * i) });
      WriteImageFile(this->Folder / cameras.back().Name, Image<std::uint8_t>(32, 24, 3).Ref());
    }
    WriteCameras(this->Folder / "v_par.txt", cameras);
    this->Dataset = ReadDatasetIndex(this->Folder.Path);
  }

  std::vector<Camera> Frames(const std::string& path)
  {
    if (!path.empty())
    {
      this->Options.Path = this->Folder / "path.json";
      WriteText(this->Options.Path, path);
    }
    return CamerasOfFrames(this->Options, this->Dataset, this->Exclude);
  }

  void ExpectRefused(const std::string& path, const std::string& text)
  {
    ExpectError([&] { this->Frames(path); }, text);
  }

  static constexpr double Rounding = 1e-7; ///< cameras have steps of 2^-26 (CameraGrid)

  static double Apart(const Camera& a, const Camera& b)
  {
    return std::max(
      (a.R - b.R).cwiseAbs().maxCoeff(), (a.Centre() - b.Centre()).cwiseAbs().maxCoeff());
  }

  TemporaryFolder Folder;
  DatasetIndex Dataset;
  TrajectoryOptions Options;
  std::vector<std::string> Exclude;
};
}

TEST_F(CameraTrajectoryTest, WithoutAPathOnceRoundTheRing)
{
  const std::vector<Camera> frames = this->Frames("");
  ASSERT_EQ(frames.size(), 72u);
  EXPECT_LT(Apart(frames[0], OnRing(0)), Rounding);
  EXPECT_LT(
    Apart(frames[1], OnRing(5)), Rounding); // as the photographs go, and without frame 72 = 0
  EXPECT_LT(Apart(frames[71], OnRing(355)), Rounding);
  EXPECT_EQ(frames[0].Width, 32);
  EXPECT_EQ(frames[0].Height, 24);
  this->Options.Frames = 8;
  EXPECT_LT(Apart(this->Frames("")[3], OnRing(135)), Rounding);
}

TEST_F(CameraTrajectoryTest, CamerasOnNoRingNeedAPath)
{
  this->Exclude = { "v3.png", "v4.png", "v5.png", "v6.png", "v7.png" };
  ExpectError([&] { this->Frames(""); }, "are on no ring", "use --path to define");
}

TEST_F(CameraTrajectoryTest, KeysByNameNumberPoseAndTarget)
{
  const std::vector<Camera> frames = this->Frames(R"({ "keys": [
    { "frame": 10, "camera": "v1.png" },
    { "frame": 12, "camera": 2 },
    { "frame": 13, "R": [[1,0,0],[0,1,0],[0,0,1]], "t": [0,0,5],
      "K": [50,0,15,0,50,12,0,0,1] },
    { "frame": 14, "position": [0,0,3], "lookAt": [0,0,0], "up": [1,0,0], "fieldOfView": 90 } ] })");
  ASSERT_EQ(frames.size(), 5u);
  EXPECT_LT(Apart(frames[0], OnRing(45)), Rounding);
  EXPECT_LT(Apart(frames[2], OnRing(90)), Rounding);
  EXPECT_LT((frames[3].Centre() - Vector3d(0, 0, -5)).norm(), 1e-12);
  EXPECT_EQ(frames[3].K(0, 0), 50);
  EXPECT_LT((frames[4].OpticalAxis() - Vector3d(0, 0, -1)).norm(), 1e-12);
  EXPECT_LT((frames[4].R.row(1).transpose() - Vector3d(-1, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(frames[4].K(0, 0), 12, 1e-9); // half of 24 px at 45 degrees
  EXPECT_EQ(frames[4].Width, 32);
}

TEST_F(CameraTrajectoryTest, CountsFramesAsTheKeysOrTheUserSay)
{
  const std::string even = R"({ "keys": [ { "camera": 0 }, { "camera": 1 }, { "camera": 2 } ]})";
  EXPECT_EQ(this->Frames(even).size(), 72u);
  this->Options.Frames = 5;
  const std::vector<Camera> five = this->Frames(even);
  ASSERT_EQ(five.size(), 5u);
  EXPECT_LT(Apart(five[2], OnRing(45)), Rounding);
  EXPECT_LT(Apart(five[4], OnRing(90)), Rounding);
  this->Options.Frames = 0;
  this->Options.Fps = 10;
  EXPECT_EQ(
    this->Frames(R"({ "keys": [ { "time": 0, "camera": 0 }, { "time": 1.5, "camera": 1 } ]})")
      .size(),
    16u);
  // Closed: two steps of 4 frames and as long a way back, whose last frame is the first.
  const std::vector<Camera> closed = this->Frames(R"({ "closed": true, "size": "16x20", "keys": [
    { "frame": 0, "camera": 0 }, { "frame": 4, "camera": 1 }, { "frame": 8, "camera": 2 } ]})");
  ASSERT_EQ(closed.size(), 12u);
  EXPECT_LT(Apart(closed[8], OnRing(90)), Rounding);
  EXPECT_EQ(closed[8].Width, 16);
  EXPECT_EQ(closed[8].Height, 20);
}

TEST_F(CameraTrajectoryTest, SlipsAreNamed)
{
  this->ExpectRefused("[]", "is not a job");
  this->ExpectRefused(R"({ "keys": [ { "camera": 0 } ] })", "an array of at least 2");
  this->ExpectRefused(R"({ "key": 1 })", "did you mean \"keys\"?");
  this->ExpectRefused(R"({ "keys": [ { "camera": 0 }, { "camera": "nobody" } ] })", "'nobody'");
  this->ExpectRefused(R"({ "keys": [ { "camera": 0, "frame": 1 }, { "camera": 1 } ] })",
    "1 of 2, expected all or none");
  this->ExpectRefused(R"({ "keys": [ { "camera": 0, "t": [0,0,0] }, { "camera": 1 } ] })",
    "key camera 0: does not state its position in one of the three ways");
  this->ExpectRefused(
    R"({ "keys": [ { "camera": 0 }, { "position": [0,0,1], "lookAt": [0,0] } ] })",
    "key camera 1, lookAt: has the wrong length (got 2, expected 3)");
  this->ExpectRefused(
    R"({ "keys": [ { "camera": 0 }, { "R": [1,0,0,0,1,0,0,0,2], "t": [0,0,1] } ] })",
    "R is not a rotation");
  this->ExpectRefused(R"({ "keys": [ { "frame": 3, "camera": 0 }, { "frame": 3, "camera": 1 } ] })",
    "key 1 is not after");
  this->ExpectRefused(R"({ "keys": [ { "camera": 0 },
    { "position": [0,5,0], "lookAt": [0,0,0], "up": [0,1,0] } ] })",
    "view direction along its up");
}
