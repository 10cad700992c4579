// SPDX-License-Identifier: GPL-3.0-or-later
/** Cameras and files for the tests of calibration formats. */
#ifndef novelview_tests_CalibrationCases_h
#define novelview_tests_CalibrationCases_h

#include "dataset/Dataset.h"
#include "formats/DatasetFormats.h"
#include "images/ImageFile.h"
#include "support/TestSupport.h"

#include <random>

namespace novelview::testing_support
{
/** Writes a text file and the folders above it. */
inline void WriteFile(const std::filesystem::path& path, const std::string& text)
{
  std::filesystem::create_directories(path.parent_path());
  WriteText(path, text);
}

/** A grey picture of this size. */
inline void WritePicture(const std::filesystem::path& path, int width, int height)
{
  WriteImageFile(path, Image<std::uint8_t>(width, height, 3, 90).Ref());
}

/** Expects a point to be seen at a pixel; 1e-9 px is rounding alone. */
inline void ExpectPixel(
  const Camera& camera, const Eigen::Vector3d& point, const Eigen::Vector2d& pixel)
{
  EXPECT_GT(camera.Depth(point), 0);
  EXPECT_NEAR(camera.Project(point).x(), pixel.x(), 1e-9);
  EXPECT_NEAR(camera.Project(point).y(), pixel.y(), 1e-9);
}

/** Cameras drawn at random; with `same` they share K, size and lens. */
inline std::vector<Photograph> RandomPhotographs(
  unsigned int seed, bool same, const Lens& lens, double skew = 0)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<Photograph> photographs;
  for (int i = 0; i < 6; ++i)
  {
    Photograph photograph;
    photograph.Name =
      i % 2 == 0 ? "a" + std::to_string(i) + ".png" : "sub/b" + std::to_string(i) + ".jpg";
    photograph.Distortion = lens;
    Camera& camera = photograph.Cam;
    camera.R = Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random))
                 .normalized()
                 .toRotationMatrix();
    camera.T = 7 * Eigen::Vector3d(unit(random), unit(random), unit(random));
    camera.Width = 640;
    camera.Height = 480;
    camera.K << 700 + 50 * unit(random), skew, 320 + 9 * unit(random), 0, 690 + 50 * unit(random),
      240 + 9 * unit(random), 0, 0, 1;
    if (same && i > 0)
    {
      camera.K = photographs.front().Cam.K;
    }
    photographs.push_back(photograph);
  }
  return photographs;
}

/** Writes the files of a calibration, without photographs. */
inline void WriteCalibration(const std::filesystem::path& folder, const std::string& format,
  const std::vector<Photograph>& photographs)
{
  for (const FileContent& file : FormatOf(format).Compose("cameras", photographs))
  {
    WriteFile(folder / file.Path, file.Bytes);
  }
}

/** Expects the same names, cameras and lenses; sizes may be unknown. */
inline void ExpectSamePhotographs(
  const std::vector<Photograph>& got, const std::vector<Photograph>& expected, double tolerance)
{
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i)
  {
    const Camera& a = got[i].Cam;
    const Camera& b = expected[i].Cam;
    EXPECT_EQ(got[i].Name, expected[i].Name);
    EXPECT_LE((a.K - b.K).cwiseAbs().maxCoeff(), tolerance) << got[i].Name;
    EXPECT_LE((a.R - b.R).cwiseAbs().maxCoeff(), tolerance) << got[i].Name;
    EXPECT_LE((a.T - b.T).cwiseAbs().maxCoeff(), tolerance) << got[i].Name;
    EXPECT_TRUE(a.Width == 0 || (a.Width == b.Width && a.Height == b.Height)) << got[i].Name;
    EXPECT_EQ(Trimmed(got[i].Distortion), Trimmed(expected[i].Distortion)) << got[i].Name;
  }
}
}

#endif
