// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/CalibrationCases.h"

using namespace novelview;
using namespace novelview::testing_support;
using testing::ElementsAre;

namespace
{
/** transforms.json with one frame: what is said for all, and in the frame besides the pose. */
class OneFrame
{
public:
  OneFrame(const std::string& shared, const std::string& own)
  {
    // At (1, 2, 3), x of the camera along the world's x, looking along -z: OpenGL's rest position.
    WriteFile(this->Folder / "transforms.json",
      "{" + shared + (shared.empty() ? "" : ",") + "\"frames\": [{" + own +
        (own.empty() ? "" : ",") +
        "\"transform_matrix\": [[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]}]}");
  }
  Photograph Read() const { return ReadDatasetIndex(this->Folder.Path).Cameras.front(); }

  TemporaryFolder Folder;
};

const std::string Sized = R"("w": 640, "h": 480, "fl_x": 500, "fl_y": 400)";
const std::string Path = R"("file_path": "a.png")";
}

TEST(NerfTransforms, AxesAreOpenGlAndPosesCameraToWorld)
{
  const OneFrame file(Sized + R"(, "cx": 300, "cy": 200)", Path);
  const Photograph read = file.Read();
  EXPECT_EQ(read.Name, "a.png");
  EXPECT_EQ(read.Cam.Centre(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(read.Cam.OpticalAxis(), Eigen::Vector3d(0, 0, -1));
  // (1.2, 2.1, 1) is 0.2 right of and 0.1 above the axis at depth 2; up is towards row 0. The centre
  // of the top-left pixel is (0.5, 0.5) in the file.
  ExpectPixel(read.Cam, { 1.2, 2.1, 1 }, { 300 + 500 * 0.1 - 0.5, 200 - 400 * 0.05 - 0.5 });
}

TEST(NerfTransforms, FieldOfViewWillDoAndTheSizeIsThePhotographs)
{
  // tan(0.5) of the half angle: 80 px = half the width.
  const OneFrame file(R"("camera_angle_x": 1.0)", R"("file_path": "./train/r_0")");
  WritePicture(file.Folder / "train/r_0.png", 160, 120);
  const Photograph read = file.Read();
  EXPECT_EQ(read.Name, "train/r_0.png");
  EXPECT_EQ(read.File, file.Folder / "train/r_0.png");
  EXPECT_EQ(SizeText(read.Cam.Width, read.Cam.Height), "160x120");
  const double f = 80 / std::tan(0.5);
  Eigen::Matrix3d k;
  k << f, 0, 79.5, 0, f, 59.5, 0, 0, 1; // the picture's middle
  EXPECT_LE((read.Cam.K - k).norm(), 1e-12);
}

TEST(NerfTransforms, AFramesNumbersGoOverTheFiles)
{
  const Photograph read =
    OneFrame(Sized + R"(, "k1": 0.1)", Path + R"(, "fl_x": 600, "w": 320, "h": 200, "k1": 0.2)")
      .Read();
  EXPECT_EQ(read.Cam.K(0, 0), 600);
  EXPECT_EQ(read.Cam.K(1, 1), 400);
  EXPECT_EQ(read.Cam.Width, 320);
  EXPECT_EQ(read.Cam.K(0, 2), 159.5);
  EXPECT_THAT(read.Distortion.Coefficients, ElementsAre(0.2));
}

TEST(NerfTransforms, LensesGoByTheCameraModel)
{
  const std::string numbers = R"(, "k1": 0.1, "k2": 0.2, "p1": 0.3, "p2": 0.4, "k3": 0.5)";
  const Lens plain = OneFrame(Sized + numbers, Path).Read().Distortion;
  EXPECT_EQ(plain.Kind, Lens::Model::Perspective);
  EXPECT_THAT(plain.Coefficients, ElementsAre(0.1, 0.2, 0.3, 0.4, 0.5));
  for (const char* fisheye : { R"(, "camera_model": "OPENCV_FISHEYE")", R"(, "is_fisheye": true)" })
  {
    const Lens lens =
      OneFrame(Sized + numbers + fisheye + R"(, "k4": 0.6)", Path).Read().Distortion;
    EXPECT_EQ(lens.Kind, Lens::Model::Fisheye);
    EXPECT_THAT(lens.Coefficients, ElementsAre(0.1, 0.2, 0.5, 0.6));
  }
}

TEST(NerfTransforms, MaskPathsAndTheImagesFolder)
{
  const OneFrame file(Sized, R"("file_path": "images/sub/a.jpg", "mask_path": "semantics/a.png")");
  const Photograph read = file.Read();
  EXPECT_EQ(read.Name, "sub/a.jpg");
  EXPECT_EQ(read.File, file.Folder / "images/sub/a.jpg");
  EXPECT_EQ(read.Mask, file.Folder / "semantics/a.png");
}

TEST(NerfTransforms, TheTrainingSplitIsReadWhereThereIsNoOther)
{
  const OneFrame file(Sized, Path);
  std::filesystem::rename(file.Folder / "transforms.json", file.Folder / "transforms_train.json");
  EXPECT_EQ(ReadDatasetIndex(file.Folder.Path).Calibration, file.Folder / "transforms_train.json");
}

TEST(NerfTransforms, WhatASplitIsUsedForIsSaid)
{
  const OneFrame file(Sized, Path);
  const auto as = [&](const std::string& name)
  { std::filesystem::copy(file.Folder / "transforms.json", file.Folder / name); };
  EXPECT_TRUE(ReadDatasetIndex(file.Folder.Path).Notes.empty());
  as("transforms_val.json");
  EXPECT_THAT(ReadDatasetIndex(file.Folder.Path).Notes.at(0).Text,
    testing::HasSubstr("transforms_val.json holds no references: evaluate predicts its views"));
  as("transforms_test.json");
  as("transforms_train.json");
  const ReadingNote note = ReadDatasetIndex(file.Folder.Path).Notes.at(0);
  EXPECT_FALSE(note.Harmful);
  EXPECT_EQ(note.Text,
    "transforms_test.json holds no references: evaluate predicts its views; transforms_train.json "
    "is not used; transforms_val.json is not used (--calibration reads another file)");
  std::filesystem::remove(file.Folder / "transforms.json");
  EXPECT_EQ(ReadDatasetIndex(file.Folder.Path).Notes.at(0).Text,
    "transforms_test.json holds no references: evaluate predicts its views; transforms_val.json "
    "is not used (--calibration reads another file)");
}

TEST(NerfTransforms, BadFilesAreNamedByFrame)
{
  const auto expect = [](const std::string& shared, const std::string& own, const auto&... parts)
  { ExpectError([&] { OneFrame(shared, own).Read(); }, "transforms.json, frame 0", parts...); };
  expect(Sized, "", "has no \"file_path\"");
  expect(R"("w": 640, "h": 480)", Path, "no focal length", "fl_x or camera_angle_x");
  expect(R"("w": 640, "h": 480, "fl_x": "x")", Path, "\"fl_x\" is not a number");
  expect(Sized + R"(, "camera_model": "EQUIRECTANGULAR")", Path, "cannot be undistorted",
    "EQUIRECTANGULAR", "OPENCV_FISHEYE");
  expect(Sized + R"(, "k4": 0.1)", Path, "k4 cannot be undistorted");
  const TemporaryFolder folder;
  const auto read = [&folder] { ReadDatasetIndex(folder.Path); };
  WriteFile(folder / "transforms.json", "{");
  ExpectError(read, "transforms.json", "is not JSON");
  WriteFile(folder / "transforms.json", "[]");
  ExpectError(read, "transforms.json", "has no \"frames\"");
  WriteFile(folder / "transforms.json", R"({"frames": []})");
  ExpectError(read, "transforms.json", "contains no camera");
  WriteFile(
    folder / "transforms.json", R"({"frames": [{"file_path": "a", "transform_matrix": [1]}]})");
  ExpectError(read, "frame 0", "no pose", "4x4 or 3x4");
}

TEST(NerfTransforms, WritesSharedNumbersOnce)
{
  const auto text = [](bool same)
  { return FormatOf("nerf").Compose("", RandomPhotographs(1, same, {})).front().Bytes; };
  const auto count = [](const std::string& all, const std::string& word)
  {
    int times = 0;
    for (std::size_t at = all.find(word); at != std::string::npos; at = all.find(word, at + 1))
    {
      ++times;
    }
    return times;
  };
  EXPECT_EQ(count(text(true), "\"fl_x\""), 1);
  EXPECT_EQ(count(text(false), "\"fl_x\""), 6);
  EXPECT_EQ(count(text(true), "\"images/sub/b1.jpg\""), 1);
}
