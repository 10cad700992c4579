// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/ScenePictures.h"

#include "ViewAccess.h"
#include "drawing/SceneActors.h"
#include "mesh/ObjectMesh.h"
#include "support/MessageOf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <filesystem>

namespace
{
using namespace novelview;
namespace fs = std::filesystem;
using testing::HasSubstr;

/** A picture of one colour whose left half is foreground. */
vtkSmartPointer<vtkImageData> HalfCovered(int width, int height, unsigned char value)
{
  vtkSmartPointer<vtkImageData> image = NewImage(width, height);
  const auto color = AddTopDownArray<unsigned char>(image, arrays::Color, 3);
  const auto mask = AddTopDownArray<unsigned char>(image, arrays::Mask, 1);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      mask(x, y) = x < width / 2 ? 255 : 0;
      std::fill_n(color.Pixel(x, y), 3, mask(x, y) ? value : 0);
    }
  }
  return image;
}

/** A ring of cameras around the torus, and everything a screenshot wants. */
class ScenePictures : public testing::Test
{
protected:
  void SetUp() override
  {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    this->File = fs::path(testing::TempDir()) / (std::string("novelview_") + info->name() + ".png");
    fs::remove(this->File);
    Eigen::Matrix3d k;
    k << 90, 0, 39.5, 0, 90, 29.5, 0, 0, 1;
    for (int i = 0; i < 6; ++i)
    {
      const double angle = i * EIGEN_PI / 3;
      const Eigen::Vector3d centre(5 * std::sin(angle), 0.4, 5 * std::cos(angle));
      this->Cameras.push_back(LookAt(centre, { 0, 0, 0 }, { 0, 1, 0 }, k, 80, 60));
      AppendView(this->Views, "v" + std::to_string(i), NewImage(80, 60), this->Cameras.back());
    }
    this->Novel = HalfCovered(80, 60, 100);
    this->Truth = HalfCovered(80, 60, 140);
    this->State.Title = "torus";
    this->State.Iteration = 2;
    this->State.Mesh = this->Mesh;
    this->State.Views = this->Views;
    this->State.Novel = InterpolateOnOrbit(this->Cameras[0], this->Cameras[1], 0.5);
    this->State.NovelImage = this->Novel;
    this->State.TruthImage = this->Truth;
    this->State.History = { { Stage::Outline, 0, 30 }, { Stage::Outline, 1, 25 },
      { Stage::Outline, 2, 22 } };
  }
  void TearDown() override { fs::remove(this->File); }

  cv::Mat Read() const { return cv::imread(this->File.string()); }

  /** How many pixels have (nearly) this colour. */
  static int Count(const cv::Mat& picture, int red, int green, int blue)
  {
    const cv::Scalar wanted(blue, green, red);
    cv::Mat same;
    cv::inRange(picture, wanted - cv::Scalar::all(3), wanted + cv::Scalar::all(3), same);
    return cv::countNonZero(same);
  }

  fs::path File;
  std::vector<Camera> Cameras;
  vtkNew<vtkMultiBlockDataSet> Views;
  vtkSmartPointer<vtkPolyData> Mesh = LoadObject("torus");
  vtkSmartPointer<vtkImageData> Novel;
  vtkSmartPointer<vtkImageData> Truth;
  Dashboard State;
};

TEST_F(ScenePictures, DesktopShowsPicturesErrorAndCurve)
{
  DrawDesktop(this->State, this->File);
  const cv::Mat picture = this->Read();
  ASSERT_EQ(picture.cols, 1600);
  ASSERT_EQ(picture.rows, 900);
  // Half of a 4:3 picture 382 pixels wide is 190 x 286 = 54,000 pixels.
  EXPECT_GT(Count(picture, 100, 100, 100), 45000) << "the novel view";
  EXPECT_GT(Count(picture, 140, 140, 140), 45000) << "the truth";
  // The error of 40 is the middle of the scale to 80: 0.73, 0.21, 0.33.
  EXPECT_GT(Count(picture, 186, 54, 84), 25000) << "the error map";
  EXPECT_GT(Count(picture, 255, 115, 51), 100) << "the curve";
  EXPECT_GT(Count(picture, 255, 194, 46), 300) << "the novel camera";
}

TEST_F(ScenePictures, ChartOfNearlyEqualScoresHadNoCurve)
{
  DrawDesktop(this->State, this->File);
  const int curve = Count(this->Read(), 255, 115, 51);
  this->State.History = { { Stage::Outline, 0, 30 }, { Stage::Outline, 1, 29.9 },
    { Stage::Outline, 2, 29.95 } };
  DrawDesktop(this->State, this->File);
  // Two lines and three dots as before; they are flatter, so the lines are shorter.
  EXPECT_GT(Count(this->Read(), 255, 115, 51), curve / 2);
}

TEST_F(ScenePictures, DesktopMarksOutlinePointsAndDisplacement)
{
  DrawDesktop(this->State, this->File);
  const cv::Mat plain = this->Read();
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName("OutlineFlag");
  vtkNew<vtkDoubleArray> moves;
  moves->SetName("Displacement");
  moves->SetNumberOfComponents(3);
  for (vtkIdType ptId = 0; ptId < this->Mesh->GetNumberOfPoints(); ++ptId)
  {
    flags->InsertNextValue(this->Mesh->GetPoint(ptId)[1] > 0.9);
    moves->InsertNextTuple3(0.15, 0, 0); // 90 / 5 * 0.15 = 2.7 px: well up the scale
  }
  this->Mesh->GetPointData()->AddArray(flags);
  this->Mesh->GetPointData()->AddArray(moves);
  DrawDesktop(this->State, this->File);
  const cv::Mat marked = this->Read();
  EXPECT_GT(Count(marked, 255, 115, 51), Count(plain, 255, 115, 51) + 200) << "outline points";
  const cv::Rect scene(8, 200, 780, 690);
  // What has not moved is light grey, what has is blue: red goes down.
  EXPECT_LT(cv::mean(marked(scene))[2], 0.95 * cv::mean(plain(scene))[2]);
}

TEST_F(ScenePictures, DesktopWorksWithoutTruthAndHistory)
{
  this->State.TruthImage = nullptr;
  this->State.History.clear();
  this->State.Step = Stage::Hull;
  DrawDesktop(this->State, this->File);
  EXPECT_GT(Count(this->Read(), 100, 100, 100), 150000) << "the novel view takes the space";
}

TEST_F(ScenePictures, SamePictureEveryTime)
{
  DrawDesktop(this->State, this->File);
  const cv::Mat first = this->Read();
  DrawDesktop(this->State, this->File);
  EXPECT_EQ(cv::norm(first, this->Read(), cv::NORM_INF), 0);
}

TEST_F(ScenePictures, SaysWhatIsWrong)
{
  vtkSmartPointer<vtkImageData> wrong = HalfCovered(40, 30, 9);
  this->State.TruthImage = wrong;
  EXPECT_THAT(MessageOf([&] { DrawDesktop(this->State, this->File); }),
    HasSubstr("truth and novel view differ in size (got 40x30, expected 80x60)"));
  this->State.Mesh = nullptr;
  EXPECT_THAT(MessageOf([&] { DrawDesktop(this->State, this->File); }),
    HasSubstr("mesh, views and novel view are all needed"));
  EXPECT_FALSE(fs::exists(this->File));
  EXPECT_THAT(MessageOf([&] { DrawCharts("t", {}, "/proc/no/such/folder/chart.png"); }),
    HasSubstr("/proc/no/such/folder"));
}

TEST_F(ScenePictures, ChartsShowBothDeformersAndBothScores)
{
  std::vector<HistoryRow> history = this->State.History;
  history.push_back({ Stage::Full, 1, 18 });
  DrawCharts("torus", history, this->File);
  const int rmsAlone = Count(this->Read(), 255, 115, 51);
  EXPECT_GT(rmsAlone, 100);
  EXPECT_GT(Count(this->Read(), 89, 184, 242), 20) << "the non-outline point";
  for (HistoryRow& row : history)
  {
    row.Ssim = 1 - row.Rms / 100;
  }
  DrawCharts("torus", history, this->File);
  EXPECT_EQ(this->Read().cols, 1600);
  // A second legend and a second curve.
  EXPECT_GT(Count(this->Read()(cv::Rect(800, 0, 800, 700)), 255, 115, 51), 100);
  DrawCharts("nothing yet", {}, this->File); // an empty table is no error
}

TEST_F(ScenePictures, RigShowsCamerasPhotographsAndHeldOutView)
{
  RigPicture rig;
  rig.Title = "torus";
  rig.Mesh = this->Mesh;
  rig.Views = this->Cameras;
  rig.Photographs.assign(6, this->Truth);
  rig.HeldOut = { this->State.Novel };
  rig.HeldOutLabels = { "30" };
  DrawRig(rig, this->File);
  const cv::Mat picture = this->Read();
  ASSERT_EQ(picture.cols, 1600);
  EXPECT_GT(Count(picture, 140, 140, 140), 3000) << "the photographs in the frusta";
  EXPECT_GT(Count(picture, 140, 179, 235), 1000) << "frusta and numbers";
  EXPECT_GT(Count(picture, 255, 194, 46), 300) << "the held-out view";
}

TEST_F(ScenePictures, UpIsFoundAlsoWhenPhotographsAreTurned)
{
  std::vector<SceneCamera> cameras;
  for (const Camera& camera : this->Cameras)
  {
    cameras.push_back({ camera, "", colours::Reference, false, {} });
  }
  // The cameras look down by 5 degrees, all the same way around the y axis.
  EXPECT_GT(UpOf(cameras).y(), 0.999);
  const Eigen::Matrix3d quarter =
    Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    Camera& camera = cameras[i].Cam;
    camera.R = (i % 2 ? quarter : Eigen::Matrix3d(quarter.transpose())) * camera.R;
    camera.T = -(camera.R * this->Cameras[i].Centre());
  }
  EXPECT_GT(UpOf(cameras).y(), 0.999);
}

TEST_F(ScenePictures, CamerasAtOnePlaceShareALabel)
{
  const auto at = [this](int place, const char* label, bool bold) {
    return SceneCamera{ this->Cameras[place], label, colours::Reference, bold, {} };
  };
  std::vector<SceneCamera> cameras = { at(0, "0", false), at(1, "1", false), at(0, "2", false),
    at(0, "3", false), at(0, "novel", true) };
  JoinLabels(cameras, 0.1);
  EXPECT_EQ(cameras[0].Label, "0, 2, 3");
  EXPECT_EQ(cameras[1].Label, "1");
  EXPECT_EQ(cameras[2].Label, "");
  EXPECT_EQ(cameras[3].Label, "");
  EXPECT_EQ(cameras[4].Label, "novel");
}
}
