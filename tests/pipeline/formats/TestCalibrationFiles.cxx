// SPDX-License-Identifier: GPL-3.0-or-later
// Calibrations of every format that are damaged or implausible: an Error in one line, or a data set.
#include "base/InputFile.h"
#include "core/PrintableText.h"
#include "support/CalibrationCases.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <sys/stat.h>

using namespace novelview;
using namespace novelview::testing_support;
using testing::HasSubstr;
using testing::Not;

namespace
{
namespace fs = std::filesystem;

const std::vector<std::string> Formats{ "middlebury", "colmap", "colmap-binary", "nerf", "opencv",
  "bouguet" };

std::vector<Photograph> SomePhotographs(const std::string& format)
{
  const bool holdsLens = format != "middlebury";
  return RandomPhotographs(
    4, true, holdsLens ? Lens{ Lens::Model::Perspective, { 0.1, -0.2, 0.01, 0.02 } } : Lens{});
}

/** Whether a camera is one that the stages can compute with. */
void ExpectPlausible(const Photograph& photograph)
{
  const Camera& camera = photograph.Cam;
  EXPECT_TRUE(camera.K.allFinite() && camera.R.allFinite() && camera.T.allFinite());
  EXPECT_GT(camera.K(0, 0), 0);
  EXPECT_LE(camera.K.cwiseAbs().maxCoeff(), 2e10);
  EXPECT_LE(camera.T.cwiseAbs().maxCoeff(), 1e12);
  EXPECT_LT((camera.R * camera.R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-2);
  EXPECT_TRUE(camera.Width >= 0 && camera.Width <= 1 << 20);
  EXPECT_TRUE(camera.Height >= 0 && camera.Height <= 1 << 20);
  for (const double coefficient : photograph.Distortion.Coefficients)
  {
    EXPECT_LE(std::abs(coefficient), 1e6);
  }
}

/** Reads a folder; the Error's line, or empty when it is a data set. */
std::string ReadOrLine(const fs::path& folder, const std::string& format)
{
  try
  {
    for (const Photograph& photograph : ReadDatasetIndex(folder, { .Format = format }).Cameras)
    {
      ExpectPlausible(photograph);
    }
    return "";
  }
  catch (const Error& error)
  {
    return error.what();
  }
}

/** Draws changes of the bytes of a file. */
class Mutator
{
public:
  explicit Mutator(unsigned int seed)
    : Random(seed)
  {
  }

  std::string Changed(std::string text)
  {
    for (std::size_t change = 0; change <= this->Below(3); ++change)
    {
      this->Change(text);
    }
    return text;
  }
  std::size_t Below(std::size_t count)
  {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(this->Random);
  }

private:
  void Change(std::string& text)
  {
    const std::size_t at = this->Below(std::max<std::size_t>(text.size(), 1));
    switch (this->Below(6))
    {
      case 0: // a bit
        text[at] = static_cast<char>(text[at] ^ (1 << this->Below(8)));
        break;
      case 1: // cut off
        text.resize(this->Below(8) == 0 ? at : text.size());
        break;
      case 2: // taken out
        text.erase(at, 1 + this->Below(20));
        break;
      case 3: // written again elsewhere
        text.insert(at, text.substr(this->Below(text.size()), this->Below(60)));
        break;
      case 4: // eight bytes that are a number of no use
      {
        const double numbers[] = { 1e308, -1e308, std::nan(""), HUGE_VAL, -1, 0 };
        const double number = numbers[this->Below(6)];
        text.replace(at, 8, reinterpret_cast<const char*>(&number), 8);
        break;
      }
      default: // a word in the place of a number
        this->ReplaceNumber(text, at);
    }
    text += text.empty() ? "x" : "";
  }

  void ReplaceNumber(std::string& text, std::size_t at)
  {
    const char* const digits = "0123456789.eE+-";
    const std::size_t begin = text.find_first_of(digits, at);
    if (begin != std::string::npos)
    {
      const std::size_t end = std::min(text.find_first_not_of(digits, begin), text.size());
      const std::vector<std::string> words{ "1e308", "-1e308", "1e999", "nan", "inf", "-1", "0",
        "99999999999999999999", "1e-308", "x", "", "[", "\"" };
      text.replace(begin, end - begin, words[this->Below(words.size())]);
    }
  }

  std::mt19937 Random;
};
}

TEST(CalibrationFiles, AnyChangeOfAFileGivesADataSetOrOneLine)
{
  for (const std::string& format : Formats)
  {
    SCOPED_TRACE(format);
    const TemporaryFolder folder;
    const std::vector<FileContent> files =
      FormatOf(format).Compose("cameras", SomePhotographs(format));
    Mutator mutator(17);
    int refused = 0;
    for (const FileContent& file : files)
    {
      WriteFile(folder / file.Path, file.Bytes);
    }
    EXPECT_EQ(ReadOrLine(folder.Path, format), "");
    for (int round = 0; round < 600; ++round)
    {
      const FileContent& file = files[mutator.Below(files.size())];
      WriteFile(folder / file.Path, mutator.Changed(file.Bytes));
      const std::string line = ReadOrLine(folder.Path, format);
      WriteFile(folder / file.Path, file.Bytes);
      refused += line.empty() ? 0 : 1;
      EXPECT_LE(line.size(), MaxInLine);
      EXPECT_TRUE(IsUtf8(line));
      EXPECT_EQ(line.find('\n'), std::string::npos);
      for (const char* foreign : { "exception", "yaml-cpp", "OpenCV(", "std::", "basic_" })
      {
        EXPECT_THAT(line, Not(HasSubstr(foreign)));
      }
    }
    EXPECT_GT(refused, 100) << "changes that nobody notices are no test";
  }
}

TEST(CalibrationFiles, CutAnywhereGivesADataSetOrOneLine)
{
  for (const std::string& format : Formats)
  {
    SCOPED_TRACE(format);
    const TemporaryFolder folder;
    std::vector<FileContent> files = FormatOf(format).Compose("cameras", SomePhotographs(format));
    const FileContent last = files.back();
    for (const FileContent& file : files)
    {
      WriteFile(folder / file.Path, file.Bytes);
    }
    for (std::size_t length = 0; length < last.Bytes.size(); length += 1 + length / 50)
    {
      WriteFile(folder / last.Path, last.Bytes.substr(0, length));
      EXPECT_LE(ReadOrLine(folder.Path, format).size(), MaxInLine);
    }
  }
}

TEST(CalibrationFiles, NumbersAtTheEndOfTheirRangeAreImplausible)
{
  std::vector<Photograph> photographs = SomePhotographs("middlebury");
  for (Photograph& photograph : photographs)
  {
    photograph.Cam.R.setIdentity();
    photograph.Cam.K << 741.25, 0, 311.5, 0, 742.25, 242.5, 0, 0, 1;
    photograph.Cam.T << 0.5, 0, 3;
  }
  const std::vector<std::pair<std::function<double&(Camera&)>, std::string>> numbers{
    { [](Camera& camera) -> double& { return camera.K(0, 0); }, "focal length fx" },
    { [](Camera& camera) -> double& { return camera.K(1, 1); }, "focal length fy" },
    { [](Camera& camera) -> double& { return camera.K(0, 2); }, "principal point cx" },
    { [](Camera& camera) -> double& { return camera.K(1, 2); }, "principal point cy" },
    { [](Camera& camera) -> double& { return camera.T.x(); }, "translation" },
  };
  for (const std::string& format : Formats)
  {
    for (const auto& [number, name] : numbers)
    {
      for (const double huge : { 1e308, 1e15, -1e308 })
      {
        SCOPED_TRACE(format + ", " + name);
        const TemporaryFolder folder;
        std::vector<Photograph> changed = photographs;
        for (Photograph& photograph : changed)
        {
          number(photograph.Cam) = huge;
        }
        WriteCalibration(folder.Path, format, changed);
        EXPECT_THAT(ReadOrLine(folder.Path, format),
          testing::AnyOf(HasSubstr(name + " is out of range"), HasSubstr("K is singular")));
      }
    }
  }
}

TEST(CalibrationFiles, ARangeThatThePhotographsSizeGivesIsCheckedWhenItIsKnown)
{
  const TemporaryFolder folder;
  std::vector<Photograph> photographs = SomePhotographs("middlebury");
  photographs.resize(1);
  photographs[0].Cam.K(0, 2) = 1e8; // fits a picture of a million pixels' width
  WriteCalibration(folder.Path, "middlebury", photographs);
  Image<std::uint8_t> picture(64, 48, 4, 255);
  WriteImageFile(folder / photographs[0].Name, picture.Ref());
  const DatasetIndex index = ReadDatasetIndex(folder.Path);
  ExpectError([&] { ReadDataset(index, {}); }, "cameras_par.txt, line 2", "principal point cx",
    "got 1e+08, expected -64000 to 64000");
}

TEST(CalibrationFiles, PipesInPlaceOfFilesDoNotHang)
{
  for (const std::string& format : Formats)
  {
    SCOPED_TRACE(format);
    const TemporaryFolder folder;
    const std::vector<FileContent> files =
      FormatOf(format).Compose("cameras", SomePhotographs(format));
    for (const FileContent& file : files)
    {
      fs::create_directories((folder / file.Path).parent_path());
      ASSERT_EQ(::mkfifo((folder / file.Path).c_str(), 0600), 0);
    }
    ExpectError(
      [&] {
        ReadDatasetIndex(
          folder.Path, { .Calibration = folder / files.back().Path, .Format = format });
      },
      "is not a regular file", "a pipe");
    ExpectError(
      [&] { ReadDatasetIndex(folder.Path, { .Format = format }); }, "no calibration file");
  }
}

TEST(CalibrationFiles, CountsOfBinaryFilesAreNotBelieved)
{
  const TemporaryFolder folder;
  WriteCalibration(folder.Path, "colmap-binary", SomePhotographs("colmap-binary"));
  for (const char* name : { "sparse/0/cameras.bin", "sparse/0/images.bin" })
  {
    const std::string good = ReadText(folder / name);
    WriteText(folder / name, std::string(7, '\xFF') + "\x7F" + good.substr(8));
    ExpectError([&] { ReadDatasetIndex(folder.Path); }, name, "file ends too early");
    WriteText(folder / name, good);
  }
}

TEST(CalibrationFiles, NamesThatTheFormatCannotHoldAreRefusedBeforeWriting)
{
  std::vector<Photograph> photographs = SomePhotographs("nerf");
  photographs[1].Name = "caf\xE9.png";
  ExpectError([&] { FormatOf("nerf").Compose("", photographs); }, "view caf\\xE9.png", "not UTF-8");
  ExpectError([&] { FormatOf("opencv").Compose("", photographs); }, "beyond ASCII");
  photographs[1].Name = "a\nb.png";
  ExpectError([&] { FormatOf("bouguet").Compose("", photographs); }, "a line break");
}

TEST(CalibrationFiles, NamesThatAreNoUtf8AreReadAsTheyAre)
{
  for (const char* format : { "middlebury", "colmap", "colmap-binary", "bouguet" })
  {
    SCOPED_TRACE(format);
    std::vector<Photograph> photographs = SomePhotographs(format);
    photographs[1].Name = "caf\xE9.png";
    const TemporaryFolder folder;
    WriteCalibration(folder.Path, format, photographs);
    EXPECT_EQ(ReadDatasetIndex(folder.Path).Cameras[1].Name, "caf\xE9.png");
  }
}
