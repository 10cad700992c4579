// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/CalibrationCases.h"

using namespace novelview;
using namespace novelview::testing_support;
using testing::ElementsAre;

namespace
{
// As the toolbox's "Save" writes it, comments and all; image 2 was not used in the calibration.
const std::string Intrinsics =
  "% Intrinsic and Extrinsic Camera Parameters\n"
  "%\n"
  "% This script file can be directly excecuted under Matlab to recover the camera intrinsic.\n"
  "\n"
  "%-- Focal length:\n"
  "fc = [ 500.000000000000000 ; 400.000000000000000 ];\n"
  "\n"
  "%-- Principal point:\n"
  "cc = [ 320.000000000000000 ; 240.000000000000000 ];\n"
  "\n"
  "%-- Skew coefficient:\n"
  "alpha_c = 0.010000000000000;\n"
  "\n"
  "%-- Distortion coefficients:\n"
  "kc = [ -0.205350860183417 ; 0.135005347255894 ; 0.001 ; -0.002 ; 0.000000000000000 ];\n"
  "\n"
  "%-- Focal length uncertainty:\n"
  "fc_error = [ 6.909441619773406 ; 6.966092290448843 ];\n"
  "\n"
  "%-- Image size:\n"
  "nx = 640;\n"
  "ny = 480;\n"
  "\n"
  "n_ima = 3;\t\t\t\t\t\t% Number of calibration images, the user's\n"
  "est_fc = [ 1 ; 1 ];\t\t\t\t\t% Estimation indicator of the two focal variables\n";
const std::string Poses = "%-- Image #1:\n"
                          "omc_1 = [ 0.000000e+000 ; 1.5707963267948966e+000 ; 0.000000e+000 ];\n"
                          "Tc_1  = [ 1.000000e-001 ; 2.000000e-001 ; 3.000000e+000 ];\n"
                          "omc_error_1 = [ 1.147040e-003 ; 1.077456e-003 ; 2.137947e-003 ];\n"
                          "\n"
                          "%-- Image #2:\n"
                          "omc_2 = [ NaN ; NaN ; NaN ];\n"
                          "Tc_2  = [ NaN ; NaN ; NaN ];\n"
                          "\n"
                          "%-- Image #10:\n"
                          "omc_10 = [ 0 ; 0 ; 0 ];\n"
                          "Tc_10  = [ 0 ; 0 ; 10 ];\n";
}

TEST(BouguetCalibration, IsReadAsTheToolboxWritesIt)
{
  const TemporaryFolder folder;
  WriteFile(folder / "Calib_Results.m", Intrinsics + Poses);
  for (const char* name : { "image1.tif", "image2.tif", "image10.tif" })
  {
    WritePicture(folder / name, 640, 480);
  }
  const DatasetIndex index = ReadDatasetIndex(folder.Path);
  EXPECT_EQ(index.Format, "bouguet");
  ASSERT_EQ(index.Cameras.size(), 2u);
  EXPECT_EQ(index.Cameras[0].Name, "image1.tif");
  EXPECT_EQ(index.Cameras[1].Name, "image10.tif");
  EXPECT_EQ(index.Cameras[1].File, folder / "image10.tif");
  const Camera& camera = index.Cameras[0].Cam;
  EXPECT_EQ(SizeText(camera.Width, camera.Height), "640x480");
  EXPECT_EQ(camera.K(0, 1), 5); // alpha_c fc(1)
  // A quarter turn about y: (-2, 0.5, 0.4) is (0.5, 0.7, 5): x = 0.1, y = 0.14. Pixel (0,0) is the
  // centre of the top-left pixel in the toolbox, too.
  ExpectPixel(camera, { -2, 0.5, 0.4 }, { 320 + 500 * (0.1 + 0.01 * 0.14), 240 + 400 * 0.14 });
  EXPECT_THAT(index.Cameras[0].Distortion.Coefficients,
    ElementsAre(-0.205350860183417, 0.135005347255894, 0.001, -0.002, 0));
}

TEST(BouguetCalibration, NamesComeFromTheToolboxesVariables)
{
  const TemporaryFolder folder;
  WriteFile(folder / "Calib_Results.m",
    Intrinsics + Poses + "calib_name = 'left';\nformat_image = 'jpg';\n");
  WritePicture(folder / "left01.jpg", 640, 480);
  WritePicture(folder / "left10.jpg", 640, 480);
  WritePicture(folder / "another.jpg", 640, 480);
  const DatasetIndex index = ReadDatasetIndex(folder.Path);
  EXPECT_EQ(index.Cameras[0].Name, "left01.jpg");
  EXPECT_EQ(index.Cameras[1].Name, "left10.jpg");
}

TEST(BouguetCalibration, BadFilesAreNamed)
{
  const TemporaryFolder folder;
  const auto expect = [&folder](const std::string& text, const auto&... parts)
  {
    WriteFile(folder / "Calib_Results.m", text);
    ExpectError([&folder] { ReadDatasetIndex(folder.Path); }, "Calib_Results.m", parts...);
  };
  expect("nx = 640;\n", "no fc of the right length", "got none");
  expect("fc = [ 500 ];\n", "line 1", "no fc of the right length", "got 1 numbers, expected 2");
  expect(Intrinsics, "contains no camera");
  expect(Intrinsics + Poses, "not as many photographs as images", "got 0, expected 3");
  expect(Intrinsics + "omc_1 = [ 0 ; 0 ; 0 ];\nimage_name_1 = 'a.png';\n", "no Tc_1");
  expect(
    Intrinsics + "kc = [ 0 ; 0 ; 0 ; 0 ; 0 ; 0 ];\n", "too many distortion coefficients", "got 6");
}

TEST(BouguetCalibration, PhotographsMustShareTheCamera)
{
  std::vector<Photograph> photographs = RandomPhotographs(1, true, {});
  const auto compose = [&photographs] { FormatOf("bouguet").Compose("", photographs); };
  photographs[3].Distortion.Coefficients = { 0.1 };
  ExpectError(compose, "view sub/b3.jpg", "one distortion for all photographs", "a0.png");
  photographs[2].Cam.Width = 100;
  ExpectError(compose, "view a2.png", "one size for all photographs");
  photographs[1].Cam.K(0, 0) += 1;
  ExpectError(compose, "view sub/b1.jpg", "one K for all photographs");
}

TEST(BouguetCalibration, HalfTurnsAreWrittenExactly)
{
  // Where the rotation vector's sign changes, naive formulas lose half the digits.
  std::vector<Photograph> photographs = RandomPhotographs(2, true, {});
  const double angles[] = { EIGEN_PI, EIGEN_PI - 1e-9, EIGEN_PI + 1e-9, 0, 1e-9, 1 };
  for (std::size_t i = 0; i < photographs.size(); ++i)
  {
    photographs[i].Cam.R =
      Eigen::AngleAxisd(angles[i], Eigen::Vector3d(0.36, 0.48, 0.8)).toRotationMatrix();
  }
  const TemporaryFolder folder;
  WriteCalibration(folder.Path, "bouguet", photographs);
  ExpectSamePhotographs(ReadDatasetIndex(folder.Path).Cameras, photographs, 1e-12);
}
