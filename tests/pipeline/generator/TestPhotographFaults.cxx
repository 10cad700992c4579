// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/SolidTexture.h"
#include "generator/Generator.h"
#include "generator/GeneratorRig.h"
#include "mesh/ObjectMesh.h"
#include "support/MessageOf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <filesystem>

namespace
{
using namespace novelview;
namespace fs = std::filesystem;

/** A small data set per call, removed at the end. */
class PhotographFaults : public testing::Test
{
protected:
  void SetUp() override
  {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    this->Folder = fs::path(testing::TempDir()) / (std::string("novelview_") + info->name());
    fs::remove_all(this->Folder);
    this->Options.Mesh = "torus";
    this->Options.Texture = "grey";
    this->Options.Views = 2;
    this->Options.Width = 96;
    this->Options.Height = 72;
    this->Options.TestAnglesDeg = {};
  }
  void TearDown() override { fs::remove_all(this->Folder); }

  cv::Mat Photograph(int viewId) const
  {
    GenerateDataset(this->Options, this->Folder);
    return cv::imread(
      (this->Folder / (this->Options.Mesh + "000" + std::to_string(viewId) + ".png")).string());
  }

  static double MaxDifference(const cv::Mat& a, const cv::Mat& b)
  {
    return cv::norm(a, b, cv::NORM_INF);
  }

  GeneratorOptions Options;
  fs::path Folder;
};

TEST_F(PhotographFaults, LightOfTheRigGoesWithTheCamera)
{
  // The torus is the same from both sides.
  this->Options.StepDeg = 180;
  EXPECT_GT(MaxDifference(this->Photograph(0), this->Photograph(1)), 20);
  this->Options.Light = "rig";
  EXPECT_LE(MaxDifference(this->Photograph(0), this->Photograph(1)), 2);
}

TEST_F(PhotographFaults, HighlightsMoveWithTheCameraAndAreClipped)
{
  const auto white = [this](int viewId)
  {
    cv::Mat grey;
    cv::extractChannel(this->Photograph(viewId), grey, 0);
    return cv::Mat(grey == 255);
  };
  EXPECT_EQ(cv::countNonZero(white(0)), 0);
  this->Options.Gloss = 1;
  const int highlight = cv::countNonZero(white(0));
  EXPECT_GT(highlight, 0);
  EXPECT_LT(highlight, 300);
  EXPECT_GT(cv::countNonZero(white(0) != white(1)), highlight / 2);
  this->Options.Exposure = 2;
  EXPECT_GT(cv::countNonZero(white(0)), 2 * highlight);
}

TEST_F(PhotographFaults, VignettingDarkensTheCorners)
{
  this->Options.Mesh = "part";
  this->Options.Fill = 2; // all over the frame, but for the hole
  const cv::Mat exact = this->Photograph(0);
  this->Options.Vignetting = 0.4;
  const cv::Mat dark = this->Photograph(0);
  const auto ratio = [&](int x, int y)
  { return static_cast<double>(dark.at<cv::Vec3b>(y, x)[0]) / exact.at<cv::Vec3b>(y, x)[0]; };
  ASSERT_GT(exact.at<cv::Vec3b>(71, 0)[0], 60);
  EXPECT_NEAR(ratio(0, 71), 0.6, 0.01);
  EXPECT_NEAR(ratio(0, 36), 1 - 0.4 * 0.64, 0.01); // half the diagonal is 60, the half width 48
}

TEST_F(PhotographFaults, DefocusBlurs)
{
  const cv::Mat sharp = this->Photograph(0);
  this->Options.DefocusPx = 1.5;
  cv::Mat expected;
  cv::GaussianBlur(sharp, expected, cv::Size(), 1.5, 0, cv::BORDER_REPLICATE);
  EXPECT_LE(MaxDifference(this->Photograph(0), expected), 1);
}

TEST_F(PhotographFaults, JpegRingsAroundTheObject)
{
  const cv::Mat exact = this->Photograph(0);
  this->Options.JpegQuality = 60;
  const cv::Mat compressed = this->Photograph(0);
  EXPECT_GT(cv::countNonZero(compressed.reshape(1)), cv::countNonZero(exact.reshape(1)));
  EXPECT_LT(cv::norm(exact, compressed, cv::NORM_L1) / exact.total() / 3, 4);
}

TEST_F(PhotographFaults, WrongLensesAreWrittenAndTheRotationsStay)
{
  const auto mesh = LoadObject("torus");
  this->Options.CalibrationNoisePx = 0.5;
  const Rig before = MakeRig(mesh, this->Options);
  this->Options.FocalNoise = 0.01;
  this->Options.PrincipalNoisePx = 2;
  const Rig rig = MakeRig(mesh, this->Options);
  EXPECT_EQ(rig.Views[1].K, before.Views[1].K);
  EXPECT_EQ(rig.Written[1].R, before.Written[1].R);
  const Eigen::Matrix3d change = rig.Written[1].K - rig.Views[1].K;
  EXPECT_EQ(change(0, 0), change(1, 1));
  EXPECT_GT(std::abs(change(0, 0)), 1e-4 * rig.Views[1].K(0, 0));
  EXPECT_LT(std::abs(change(0, 0)), 0.05 * rig.Views[1].K(0, 0));
  EXPECT_GT(std::hypot(change(0, 2), change(1, 2)), 0.01);
  EXPECT_LT(std::hypot(change(0, 2), change(1, 2)), 10);
}

TEST_F(PhotographFaults, EverySecondCameraIsOnTheSecondRing)
{
  this->Options.Views = 4;
  this->Options.ElevationDeg = 10;
  this->Options.SecondRingDeg = 25;
  this->Options.TestAnglesDeg = { 15 };
  const Rig rig = MakeRig(LoadObject("torus"), this->Options);
  const auto elevationDeg = [](const Camera& camera)
  { return std::asin(camera.Centre().normalized().y()) * 180 / EIGEN_PI; };
  EXPECT_NEAR(elevationDeg(rig.Views[0]), 10, 0.1);
  EXPECT_NEAR(elevationDeg(rig.Views[1]), 35, 0.1);
  EXPECT_NEAR(elevationDeg(rig.Views[2]), 10, 0.1);
  EXPECT_NEAR(elevationDeg(rig.Tests[0]), 10, 0.1);

  this->Options.SecondRingDeg = 80;
  EXPECT_THAT(MessageOf([this] { ValidateGeneratorOptions(this->Options); }),
    testing::HasSubstr("second ring"));
}
}
