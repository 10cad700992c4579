// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/NumberText.h"
#include "support/CalibrationCases.h"

#include <cstring>

using namespace novelview;
using namespace novelview::testing_support;
using testing::ElementsAre;

namespace
{
// As in COLMAP's documentation of the format: ids neither ordered nor without gaps, two lines per
// image, the second of which may be empty.
const char* const CamerasText = "# Camera list with one line of data per camera:\n"
                                "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n"
                                "# Number of cameras: 2\n"
                                "4 PINHOLE 640 480 500 400 320 240\n"
                                "9 SIMPLE_RADIAL 100 80 200 50 40 0.25\n";
// sqrt(1/2) (1, 0, 1, 0): a quarter turn about y, x_cam = (z, y, -x) + t.
const char* const ImagesText =
  "# Image list with two lines of data per image:\n"
  "#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
  "#   POINTS2D[] as (X, Y, POINT3D_ID)\n"
  "# Number of images: 2, mean observations per image: 1\n"
  "7 1 0 0 0 0 0 10 9 left/P1180142.JPG\n"
  "\n"
  "3 0.70710678118654757 0 0.70710678118654757 0 0.1 0.2 3 4 P1180141.JPG\n"
  "2362.39 248.498 58396 1784.7 268.254 -1\n";

template <class T>
void Put(std::string& bytes, T value)
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

/** The same model byte by byte: counts are 64 bits, ids 32, numbers doubles. */
std::string CamerasBinary()
{
  std::string bytes;
  Put<std::uint64_t>(bytes, 2);
  Put<std::uint32_t>(bytes, 4);
  Put<std::int32_t>(bytes, 1); // PINHOLE
  Put<std::uint64_t>(bytes, 640);
  Put<std::uint64_t>(bytes, 480);
  for (const double parameter : { 500, 400, 320, 240 })
  {
    Put<double>(bytes, parameter);
  }
  Put<std::uint32_t>(bytes, 9);
  Put<std::int32_t>(bytes, 2); // SIMPLE_RADIAL
  Put<std::uint64_t>(bytes, 100);
  Put<std::uint64_t>(bytes, 80);
  for (const double parameter : { 200.0, 50.0, 40.0, 0.25 })
  {
    Put<double>(bytes, parameter);
  }
  return bytes;
}

std::string ImagesBinary()
{
  std::string bytes;
  Put<std::uint64_t>(bytes, 2);
  Put<std::uint32_t>(bytes, 7);
  for (const double number : { 1, 0, 0, 0, 0, 0, 10 })
  {
    Put<double>(bytes, number);
  }
  Put<std::uint32_t>(bytes, 9);
  bytes += "left/P1180142.JPG";
  bytes += '\0';
  Put<std::uint64_t>(bytes, 0);
  Put<std::uint32_t>(bytes, 3);
  for (const double number : { 0.70710678118654757, 0.0, 0.70710678118654757, 0.0, 0.1, 0.2, 3.0 })
  {
    Put<double>(bytes, number);
  }
  Put<std::uint32_t>(bytes, 4);
  bytes += "P1180141.JPG";
  bytes += '\0';
  Put<std::uint64_t>(bytes, 2);
  for (int point = 0; point < 2; ++point)
  {
    Put<double>(bytes, 2362.39);
    Put<double>(bytes, 248.498);
    Put<std::int64_t>(bytes, -1);
  }
  return bytes;
}

void ExpectTheModel(const DatasetIndex& index)
{
  // In the order of the image ids.
  ASSERT_EQ(index.Cameras.size(), 2u);
  const Photograph& a = index.Cameras[0];
  const Photograph& b = index.Cameras[1];
  EXPECT_EQ(a.Name, "P1180141.JPG");
  EXPECT_EQ(b.Name, "left/P1180142.JPG");
  EXPECT_EQ(SizeText(a.Cam.Width, a.Cam.Height), "640x480");
  // (-2, 0.5, 0.4) is (0.4, 0.5, 2) + t = (0.5, 0.7, 5) in the camera: (320 + 500 / 10,
  // 240 + 400 * 0.14) = (370, 296) where the top-left pixel's centre is (0.5, 0.5).
  ExpectPixel(a.Cam, { -2, 0.5, 0.4 }, { 369.5, 295.5 });
  EXPECT_TRUE(a.Distortion.IsPinhole());
  // (5, 0, 0) is (5, 0, 10): x = 0.5, distorted 0.5 (1 + 0.25 / 4) = 0.53125.
  ExpectPixel(b.Cam, { 5, 0, 0 }, { 149.5, 39.5 });
  EXPECT_NEAR(Distort(b.Distortion, b.Cam.K, { 149.5, 39.5 }).x(), 49.5 + 200 * 0.53125, 1e-9);
  EXPECT_THAT(b.Distortion.Coefficients, ElementsAre(0.25));
}

/** A folder with one camera line and one image. */
class OneCamera
{
public:
  explicit OneCamera(const std::string& line)
  {
    WriteFile(this->Folder / "cameras.txt", line + "\n");
    WriteFile(this->Folder / "images.txt", "1 1 0 0 0 0 0 10 1 a.png\n\n");
  }
  Photograph Read() const { return ReadDatasetIndex(this->Folder.Path).Cameras.front(); }

private:
  TemporaryFolder Folder;
};
}

TEST(Colmap, TextIsReadWhereverColmapPutsIt)
{
  for (const std::string place : { ".", "sparse", "sparse/0" })
  {
    const TemporaryFolder folder;
    WriteFile(folder / place / "cameras.txt", CamerasText);
    WriteFile(folder / place / "images.txt", ImagesText);
    const DatasetIndex index = ReadDatasetIndex(folder.Path);
    EXPECT_EQ(index.Format, "colmap");
    ExpectTheModel(index);
  }
}

TEST(Colmap, BinaryIsReadTheSame)
{
  const TemporaryFolder folder;
  WriteFile(folder / "sparse/0/cameras.bin", CamerasBinary());
  WriteFile(folder / "sparse/0/images.bin", ImagesBinary());
  ExpectTheModel(ReadDatasetIndex(folder.Path));
  ExpectTheModel(ReadDatasetIndex(folder.Path, { .Format = "colmap-binary" }));
  // Where both are there the binary model counts, as in COLMAP.
  WriteFile(folder / "sparse/0/cameras.txt", "1 PINHOLE 2 2 1 1 1 1\n");
  WriteFile(folder / "sparse/0/images.txt", "1 1 0 0 0 0 0 1 1 other.png\n");
  ExpectTheModel(ReadDatasetIndex(folder.Path));
}

TEST(Colmap, AnotherModelIsChosenByItsFolderOrFile)
{
  const TemporaryFolder folder;
  WriteFile(folder / "sparse/0/cameras.txt", "1 PINHOLE 2 2 1 1 1 1\n");
  WriteFile(folder / "sparse/0/images.txt", "1 1 0 0 0 0 0 1 1 other.png\n");
  WriteFile(folder / "sparse/1/cameras.bin", CamerasBinary());
  WriteFile(folder / "sparse/1/images.bin", ImagesBinary());
  ExpectTheModel(ReadDatasetIndex(folder.Path, { folder / "sparse/1" }));
  ExpectTheModel(ReadDatasetIndex(folder.Path, { folder / "sparse/1/images.bin" }));
}

TEST(Colmap, OfSeveralModelsTheOneWithMostImagesIsReadAndSaid)
{
  const TemporaryFolder folder;
  WriteFile(folder / "sparse/0/cameras.txt", "1 PINHOLE 2 2 1 1 1 1\n");
  WriteFile(folder / "sparse/0/images.txt", "1 1 0 0 0 0 0 1 1 other.png\n");
  WriteFile(folder / "sparse/1/cameras.bin", CamerasBinary());
  WriteFile(folder / "sparse/1/images.bin", ImagesBinary());
  // What newer versions write beside them says nothing about the cameras that these do not.
  WriteFile(folder / "sparse/1/rigs.bin", "rigs");
  WriteFile(folder / "sparse/1/frames.bin", "frames");
  const DatasetIndex index = ReadDatasetIndex(folder.Path);
  ExpectTheModel(index);
  ASSERT_EQ(index.Notes.size(), 1u);
  EXPECT_EQ(index.Notes[0].Text,
    "several COLMAP models: read sparse/1 (2 images), not sparse/0 (1 images); --calibration "
    "chooses");
}

TEST(Colmap, PhotographsWithoutACameraAreCounted)
{
  const TemporaryFolder folder;
  WriteFile(folder / "sparse/0/cameras.txt", "1 PINHOLE 2 2 1 1 1 1\n");
  WriteFile(folder / "sparse/0/images.txt", "1 1 0 0 0 0 0 1 1 a.png\n");
  for (const char* name : { "images/a.png", "images/b.png", "images/c.png", "images/a_mask.png" })
  {
    WriteFile(folder / name, "");
  }
  const DatasetIndex index = ReadDatasetIndex(folder.Path);
  ASSERT_EQ(index.Notes.size(), 1u);
  EXPECT_EQ(index.Notes[0].Text,
    "the calibration has no camera for 2 pictures beside its photographs: images/b.png, "
    "images/c.png");
}

TEST(Colmap, PhotographsAndMasksAreFoundInSubfolders)
{
  const TemporaryFolder folder;
  WriteFile(folder / "sparse/cameras.txt", CamerasText);
  WriteFile(folder / "sparse/images.txt", ImagesText);
  WritePicture(folder / "images/left/P1180142.JPG", 100, 80);
  WritePicture(folder / "P1180141.JPG", 640, 480);
  WritePicture(folder / "masks/left/P1180142.JPG.png", 100, 80);
  const DatasetIndex index = ReadDatasetIndex(folder.Path);
  EXPECT_EQ(index.Cameras[0].File, folder / "P1180141.JPG");
  EXPECT_EQ(index.Cameras[1].File, folder / "images/left/P1180142.JPG");
  EXPECT_EQ(index.Cameras[0].Mask, "");
  EXPECT_EQ(index.Cameras[1].Mask, folder / "masks/left/P1180142.JPG.png");
}

TEST(Colmap, EveryModelOpenCvCanUndistortIsRead)
{
  struct Case
  {
    const char* Line;
    double Fx, Fy, Cx, Cy;
    bool IsFisheye;
    std::vector<double> Lens;
  };
  // Parameters in the order of COLMAP's documentation of its camera models.
  const std::vector<Case> cases{
    { "1 SIMPLE_PINHOLE 64 48 50 30 20", 50, 50, 30, 20, false, {} },
    { "1 PINHOLE 64 48 50 51 30 20", 50, 51, 30, 20, false, {} },
    { "1 SIMPLE_RADIAL 64 48 50 30 20 .1", 50, 50, 30, 20, false, { .1 } },
    { "1 RADIAL 64 48 50 30 20 .1 .2", 50, 50, 30, 20, false, { .1, .2 } },
    { "1 OPENCV 64 48 50 51 30 20 .1 .2 .3 .4", 50, 51, 30, 20, false, { .1, .2, .3, .4 } },
    { "1 FULL_OPENCV 64 48 50 51 30 20 .1 .2 .3 .4 .5 .6 .7 .8", 50, 51, 30, 20, false,
      { .1, .2, .3, .4, .5, .6, .7, .8 } },
    { "1 OPENCV_FISHEYE 64 48 50 51 30 20 .1 .2 .3 .4", 50, 51, 30, 20, true, { .1, .2, .3, .4 } },
    { "1 SIMPLE_RADIAL_FISHEYE 64 48 50 30 20 .1", 50, 50, 30, 20, true, { .1 } },
    { "1 RADIAL_FISHEYE 64 48 50 30 20 .1 .2", 50, 50, 30, 20, true, { .1, .2 } },
    { "1 SIMPLE_FISHEYE 64 48 50 30 20", 50, 50, 30, 20, true, {} },
    { "1 FISHEYE 64 48 50 51 30 20", 50, 51, 30, 20, true, {} },
  };
  for (const Case& each : cases)
  {
    const Photograph read = OneCamera(each.Line).Read();
    Eigen::Matrix3d k;
    k << each.Fx, 0, each.Cx - 0.5, 0, each.Fy, each.Cy - 0.5, 0, 0, 1;
    EXPECT_EQ(read.Cam.K, k) << each.Line;
    EXPECT_EQ(read.Distortion.Kind == Lens::Model::Fisheye, each.IsFisheye) << each.Line;
    EXPECT_EQ(read.Distortion.Coefficients, each.Lens) << each.Line;
    EXPECT_EQ(read.Distortion.IsPinhole(), !each.IsFisheye && each.Lens.empty()) << each.Line;
  }
}

TEST(Colmap, OtherModelsAreNamed)
{
  for (const char* line : { "1 FOV 64 48 50 51 30 20 .9",
         "1 THIN_PRISM_FISHEYE 64 48 50 51 30 20 0 0 0 0 0 0 0 0", "1 NEWEST 64 48 50" })
  {
    ExpectError([line] { OneCamera(line).Read(); }, "cameras.txt, line 1",
      "camera model cannot be undistorted", Words(line)[1], "SIMPLE_PINHOLE, PINHOLE");
  }
}

TEST(Colmap, QuaternionsOfFewDigitsAreNormalised)
{
  const TemporaryFolder folder;
  WriteFile(folder / "cameras.txt", "1 PINHOLE 640 480 500 500 320 240\n");
  WriteFile(folder / "images.txt",
    "1 0.851773 0.0165051 0.503764 -0.142941 -0.737434 1.02973 3.74354 1 P1180141.JPG\n");
  const Camera camera = ReadDatasetIndex(folder.Path).Cameras.front().Cam;
  // A rotation to the last bit or two, though the file has six digits.
  EXPECT_LE((camera.R * camera.R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

TEST(Colmap, BadTextIsNamedByFileAndLine)
{
  const TemporaryFolder folder;
  const auto read = [&folder] { ReadDatasetIndex(folder.Path); };
  const auto with = [&folder](const std::string& cameras, const std::string& images)
  {
    WriteFile(folder / "cameras.txt", cameras);
    WriteFile(folder / "images.txt", images);
  };
  const std::string camera = "1 PINHOLE 640 480 500 500 320 240\n";
  with("# none\n", "");
  ExpectError(read, "images.txt", "calibration contains no camera");
  with("1 PINHOLE 640\n", "");
  ExpectError(read, "cameras.txt, line 1", "camera line is short", "got 3 words");
  with("1 PINHOLE 640 480 500 5oo 320 240\n", "");
  ExpectError(read, "cameras.txt, line 1", "camera parameter is not a number", "'5oo'");
  with("1 PINHOLE 640 480 500 320 240\n", "1 1 0 0 0 0 0 1 1 a.png\n\n");
  ExpectError(read, "cameras.txt, line 1", "parameters for PINHOLE", "got 3, expected 4");
  with(camera + camera, "");
  ExpectError(read, "cameras.txt, line 2", "camera 1 is there twice");
  with(camera, "1 1 0 0 0 0 0 1 1\n");
  ExpectError(read, "images.txt, line 1", "image line is short");
  with(camera, "1 1 0 0 0 0 0 1 5 a.png\n\n");
  ExpectError(read, "images.txt, line 1", "a.png has no camera", "camera 5");
  with(camera, "1 2 0 0 0 0 0 1 1 a.png\n\n");
  ExpectError(read, "images.txt, line 1", "quaternion is not of length 1", "got 2");
  with(camera, "1 1 0 0 0 0 0 1 1 a.png\n\n2 1 0 0 0 0 0 2 1 a.png\n\n");
  ExpectError(read, "images.txt, line 3", "a.png is there twice");
  // Every second image would be taken for the points of the one before, unnoticed.
  with(camera, "1 1 0 0 0 0 0 1 1 a.png\n2 1 0 0 0 0 0 2 1 b.png\n");
  ExpectError(read, "images.txt, line 2", "not a line of points", "every image has two lines");
}

TEST(Colmap, BadBinaryIsNamedByFileAndByte)
{
  const TemporaryFolder folder;
  const auto read = [&folder] { ReadDatasetIndex(folder.Path); };
  WriteFile(folder / "images.bin", ImagesBinary());
  WriteFile(folder / "cameras.bin", CamerasBinary().substr(0, 40));
  ExpectError(read, "cameras.bin, byte 40", "ends too early");
  WriteFile(folder / "cameras.bin", CamerasBinary() + "x");
  ExpectError(read, "cameras.bin", "continues after its end", "got 1 bytes");
  std::string unknown = CamerasBinary();
  unknown[12] = 99;
  WriteFile(folder / "cameras.bin", unknown);
  ExpectError(read, "cameras.bin, byte 8", "unknown camera model", "got 99");
  WriteFile(folder / "cameras.bin", CamerasBinary());
  // At every length but the whole one it is an error, never a crash.
  for (std::size_t length = 0; length < ImagesBinary().size(); ++length)
  {
    WriteFile(folder / "images.bin", ImagesBinary().substr(0, length));
    ExpectError(read, "images.bin, byte", "ends too early");
  }
  // A count of points that no file can contain.
  std::string huge = ImagesBinary();
  const std::size_t count = huge.size() - 2 * 24 - 8;
  huge[count + 7] = '\x7f';
  WriteFile(folder / "images.bin", huge);
  ExpectError(read, "images.bin, byte", "ends too early");
}

TEST(Colmap, WritesOneCameraForAllPhotographsThatShareIt)
{
  const std::vector<FileContent> shared =
    FormatOf("colmap").Compose("", RandomPhotographs(1, true, {}));
  const std::vector<FileContent> own =
    FormatOf("colmap").Compose("", RandomPhotographs(1, false, {}));
  // The model's files; images last, since they make it a model.
  ASSERT_EQ(shared.size(), 3u);
  EXPECT_EQ(shared[0].Path, "sparse/0/points3D.txt");
  EXPECT_EQ(shared[2].Path, "sparse/0/images.txt");
  const auto lines = [](const std::string& text)
  { return std::count(text.begin(), text.end(), '\n'); };
  EXPECT_EQ(lines(shared[1].Bytes), 3 + 1);
  EXPECT_EQ(lines(own[1].Bytes), 3 + 6);
  EXPECT_EQ(lines(shared[2].Bytes), 4 + 2 * 6);
}

TEST(Colmap, WhatItCannotHoldIsRefused)
{
  ExpectError([] { FormatOf("colmap").Compose("", RandomPhotographs(1, true, {}, 0.5)); },
    "view a0.png", "K has a skew, which the format colmap cannot represent", "got 0.5, expected 0");
  std::vector<Photograph> blank = RandomPhotographs(1, true, {});
  blank[0].Name = "a 0.png";
  ExpectError([&blank] { FormatOf("colmap").Compose("", blank); }, "'a 0.png'", "colmap-binary");
  // The binary encoding holds any name.
  const TemporaryFolder folder;
  WriteCalibration(folder.Path, "colmap-binary", blank);
  EXPECT_EQ(ReadDatasetIndex(folder.Path).Cameras[0].Name, "a 0.png");
}
