// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/CalibrationCases.h"

using namespace novelview;
using namespace novelview::testing_support;
using testing::ElementsAre;

namespace
{
const std::string Matrix = "camera_matrix: !!opencv-matrix\n"
                           "   rows: 3\n"
                           "   cols: 3\n"
                           "   dt: d\n"
                           "   data: [ 500., 0., 320., 0., 400., 240., 0., 0., 1. ]\n";

// In the form of OpenCV's samples/cpp/calibration.cpp.
const std::string Sample = "%YAML:1.0\n"
                           "---\n"
                           "calibration_time: \"Tue 01 Mar 2022\"\n"
                           "nframes: 2\n"
                           "image_width: 640\n"
                           "image_height: 480\n"
                           "flags: 0\n" +
  Matrix +
  "distortion_coefficients: !!opencv-matrix\n"
  "   rows: 5\n"
  "   cols: 1\n"
  "   dt: d\n"
  "   data: [ -0.25, 0.125, 0.001, 0.002, 0.5 ]\n"
  "avg_reprojection_error: 0.3\n"
  "# a set of 6-tuples (rotation vector + translation vector) for each view\n"
  "extrinsic_parameters: !!opencv-matrix\n"
  "   rows: 2\n"
  "   cols: 6\n"
  "   dt: d\n"
  "   data: [ 0., 1.5707963267948966, 0., 0.1, 0.2, 3., 0., 0., 0., 0., 0., 10. ]\n";

std::string Views(const std::string& view)
{
  return "%YAML:1.0\n---\n" + Matrix + "views:\n   -\n" + view;
}
}

TEST(OpenCvCalibration, TheSamplesFormIsReadWithPhotographsInNaturalOrder)
{
  const TemporaryFolder folder;
  WriteFile(folder / "out_camera_data.yml", Sample);
  WritePicture(folder / "view10.png", 640, 480);
  WritePicture(folder / "view9.png", 640, 480);
  WritePicture(folder / "view9_mask.png", 640, 480);
  const DatasetIndex index = ReadDatasetIndex(folder.Path);
  EXPECT_EQ(index.Format, "opencv");
  ASSERT_EQ(index.Cameras.size(), 2u);
  EXPECT_EQ(index.Cameras[0].Name, "view9.png");
  EXPECT_EQ(index.Cameras[1].Name, "view10.png");
  EXPECT_EQ(index.Cameras[0].Mask, folder / "view9_mask.png");
  // A quarter turn about y: (-2, 0.5, 0.4) is (0.4, 0.5, 2) + t = (0.5, 0.7, 5) in the camera.
  ExpectPixel(index.Cameras[0].Cam, { -2, 0.5, 0.4 }, { 370, 296 });
  ExpectPixel(index.Cameras[1].Cam, { 1, 1, 0 }, { 370, 280 });
  EXPECT_EQ(SizeText(index.Cameras[0].Cam.Width, index.Cameras[0].Cam.Height), "640x480");
  EXPECT_THAT(
    index.Cameras[0].Distortion.Coefficients, ElementsAre(-0.25, 0.125, 0.001, 0.002, 0.5));
}

TEST(OpenCvCalibration, PhotographsMayBeListed)
{
  const TemporaryFolder folder;
  WriteFile(folder / "c.yml", Sample + "images: [ \"b.png\", \"a.png\" ]\n");
  const DatasetIndex index = ReadDatasetIndex(folder.Path, { .Convention = {} });
  EXPECT_EQ(index.Cameras[0].Name, "b.png");
  EXPECT_EQ(index.Cameras[1].File, folder / "a.png");
}

TEST(OpenCvCalibration, ASampleMayBeOfAFisheyeLens)
{
  const TemporaryFolder folder;
  std::string sample = Sample + "images: [ \"b.png\", \"a.png\" ]\nfisheye_model: 1\n";
  sample.replace(sample.find("rows: 5"), 7, "rows: 4");
  sample.replace(sample.find(", 0.5 ]"), 7, " ]");
  WriteFile(folder / "c.yml", sample);
  const Lens lens = ReadDatasetIndex(folder.Path).Cameras[1].Distortion;
  EXPECT_EQ(lens.Kind, Lens::Model::Fisheye);
  EXPECT_EQ(lens.Coefficients, (std::vector<double>{ -0.25, 0.125, 0.001, 0.002 }));
}

TEST(OpenCvCalibration, AViewsNumbersGoOverTheFiles)
{
  const TemporaryFolder folder;
  WriteFile(folder / "cameras.yaml",
    Views("     image: \"images/a.png\"\n"
          "     mask: \"m/a.png\"\n"
          "     image_width: 64\n"
          "     image_height: 48\n"
          "     rvec: [ 0., 1.5707963267948966, 0. ]\n"
          "     tvec: [ 0.1, 0.2, 3. ]\n"
          "   -\n"
          "     image: \"b.png\"\n"
          "     camera_matrix: [ 100, 0, 3, 0, 100, 4, 0, 0, 1 ]\n"
          "     distortion_model: \"fisheye\"\n"
          "     distortion_coefficients: [ 0.1, 0.2, 0., 0. ]\n"
          "     R: [ 0, 0, 1, 0, 1, 0, -1, 0, 0 ]\n"
          "     tvec: [ 0.1, 0.2, 3. ]\n"));
  const DatasetIndex index = ReadDatasetIndex(folder.Path);
  ASSERT_EQ(index.Cameras.size(), 2u);
  const Photograph& a = index.Cameras[0];
  const Photograph& b = index.Cameras[1];
  EXPECT_EQ(a.Name, "a.png");
  EXPECT_EQ(a.File, folder / "images/a.png");
  EXPECT_EQ(a.Mask, folder / "m/a.png");
  EXPECT_EQ(a.Cam.Height, 48);
  ExpectPixel(a.Cam, { -2, 0.5, 0.4 }, { 370, 296 });
  ExpectPixel(b.Cam, { -2, 0.5, 0.4 }, { 3 + 10, 4 + 14 });
  EXPECT_EQ(b.Cam.Width, 0);
  EXPECT_EQ(b.Distortion.Kind, Lens::Model::Fisheye);
}

TEST(OpenCvCalibration, XmlIsReadTheSame)
{
  const TemporaryFolder folder;
  WriteFile(folder / "c.xml",
    "<?xml version=\"1.0\"?>\n<opencv_storage>\n"
    "<Camera_Matrix type_id=\"opencv-matrix\"><rows>3</rows><cols>3</cols><dt>d</dt>"
    "<data>500 0 320 0 400 240 0 0 1</data></Camera_Matrix>\n"
    "<Extrinsic_Parameters type_id=\"opencv-matrix\"><rows>1</rows><cols>6</cols><dt>d</dt>"
    "<data>0 1.5707963267948966 0 0.1 0.2 3</data></Extrinsic_Parameters>\n"
    "<images>\n a.png\n</images>\n</opencv_storage>\n");
  const DatasetIndex index = ReadDatasetIndex(folder.Path);
  ASSERT_EQ(index.Cameras.size(), 1u);
  EXPECT_EQ(index.Cameras[0].Name, "a.png");
  ExpectPixel(index.Cameras[0].Cam, { -2, 0.5, 0.4 }, { 370, 296 });
}

TEST(OpenCvCalibration, OtherYamlFilesAreNoCalibration)
{
  const TemporaryFolder folder;
  WriteFile(folder / "config.yml", "%YAML:1.0\n---\nsettings: 1\n");
  ExpectError([&folder] { ReadDatasetIndex(folder.Path); }, "no calibration file");
}

TEST(OpenCvCalibration, BadFilesAreNamed)
{
  const TemporaryFolder folder;
  const auto expect = [&folder](const std::string& text, const auto&... parts)
  {
    WriteFile(folder / "c.yml", text);
    ExpectError([&folder] { ReadDatasetIndex(folder.Path); }, "c.yml", parts...);
  };
  expect(Sample, "not as many photographs as poses", "got 0, expected 2");
  expect("%YAML:1.0\n---\n" + Matrix, "no poses", "\"views\", or \"extrinsic_parameters\"");
  expect("camera_matrix: [\n", "is not a calibration of OpenCV");
  expect(Views("     tvec: [ 0, 0, 1 ]\n"), "view 0", "has no \"image\"");
  const std::string image = "     image: \"a.png\"\n";
  expect(Views(image + "     tvec: [ 0, 0, 1 ]\n"), "view 0 (a.png)", "\"rvec\"", "got none");
  expect(Views(image + "     rvec: [ 0, 0, 0 ]\n     tvec: [ 0, 0 ]\n"), "\"tvec\"",
    "got 2 numbers, expected 3");
  expect(Views(image +
           "     distortion_model: \"omnidir\"\n     rvec: [ 0, 0, 0 ]\n"
           "     tvec: [ 0, 0, 1 ]\n"),
    "unknown distortion model", "omnidir");
  expect(Views(image + "     R: [ 1, 0, 0, 0, 2, 0, 0, 0, 1 ]\n     tvec: [ 0, 0, 1 ]\n"),
    "view 0 (a.png)", "R is not a rotation");
}
