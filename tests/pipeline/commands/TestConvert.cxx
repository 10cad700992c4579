// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/UsageError.h"
#include "commands/ConvertCommand.h"
#include "support/CalibrationCases.h"

#include <map>

using namespace novelview;
using namespace novelview::testing_support;
namespace fs = std::filesystem;

namespace
{
/** A COLMAP data set with photographs of noise, in PNG and JPEG, and one mask. */
class Convert : public testing::Test
{
protected:
  explicit Convert(const Lens& lens = {})
    : Photographs(RandomPhotographs(21, true, lens))
  {
  }
  void SetUp() override
  {
    std::mt19937 random(3);
    for (const Photograph& photograph : this->Photographs)
    {
      Image<std::uint8_t> picture(640, 480, 3);
      for (std::size_t i = 0; i < picture.Values.size(); i += 7)
      {
        picture.Values[i] = static_cast<std::uint8_t>(random());
      }
      WriteImageFile(this->In() / "images" / photograph.Name, picture.Ref());
    }
    Image<std::uint8_t> mask(640, 480);
    mask(100, 200) = 255;
    WriteImageFile(this->In() / "masks/sub/b1.jpg.png", mask.Ref());
    WriteCalibration(this->In(), "colmap", this->Photographs);
  }

  fs::path In() const { return this->Folder / "in"; }
  fs::path Out() const { return this->Folder / "out"; }
  ConvertOptions Options(const std::string& format) const
  {
    ConvertOptions options;
    options.Dataset = this->In();
    options.Out = this->Out();
    options.Format = format;
    return options;
  }
  void Run(const ConvertOptions& options) const
  {
    Console console(Verbosity::Quiet);
    ConvertDataset(options, console);
  }
  std::vector<std::string> Written() const
  {
    std::vector<std::string> names;
    if (fs::exists(this->Out()))
    {
      for (const auto& entry : fs::recursive_directory_iterator(this->Out()))
      {
        if (entry.is_regular_file())
        {
          names.push_back(entry.path().lexically_relative(this->Out()).string());
        }
      }
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  std::vector<Photograph> Photographs;
  TemporaryFolder Folder;
};

class ConvertDistorted : public Convert
{
protected:
  ConvertDistorted()
    : Convert({ Lens::Model::Perspective, { -0.2, 0.05, 0.001, 0.002 } })
  {
  }
};
}

TEST_F(Convert, CopiesPhotographsAndMasksByteForByte)
{
  // The others have no subfolders.
  for (const char* format :
    { "middlebury", "colmap", "colmap-binary", "nerf", "opencv", "bouguet" })
  {
    SCOPED_TRACE(format);
    fs::remove_all(this->Out());
    this->Run(this->Options(format));
    const DatasetIndex read = ReadDatasetIndex(this->Out());
    ExpectSamePhotographs(read.Cameras, this->Photographs, 1e-9);
    for (const Photograph& photograph : read.Cameras)
    {
      EXPECT_EQ(ReadText(photograph.File), ReadText(this->In() / "images" / photograph.Name));
      EXPECT_EQ(photograph.Mask.empty(), photograph.Name != "sub/b1.jpg") << photograph.Name;
    }
    EXPECT_EQ(ReadText(read.Cameras[1].Mask), ReadText(this->In() / "masks/sub/b1.jpg.png"));
  }
}

TEST_F(Convert, ThereAndBackIsTheSameDataSet)
{
  this->Run(this->Options("nerf"));
  ConvertOptions back = this->Options("colmap");
  back.Dataset = this->Out();
  back.Out = this->Folder / "back";
  this->Run(back);
  for (const char* name : { "sparse/0/cameras.txt", "images/a0.png", "masks/sub/b1.jpg.png" })
  {
    EXPECT_EQ(ReadText(this->In() / name), ReadText(back.Out / name)) << name;
  }
}

TEST_F(Convert, LeavesPhotographsOutAndInvertsMasks)
{
  ConvertOptions options = this->Options("middlebury");
  options.Exclude = { "a0.png", "a2.png" };
  options.Source.Convention.InvertMasks = true;
  this->Run(options);
  const DatasetIndex read = ReadDatasetIndex(this->Out());
  ASSERT_EQ(read.Cameras.size(), 4u);
  const Image<std::uint8_t> mask = ReadGreyFile(read.Cameras[0].Mask);
  EXPECT_EQ(mask(100, 200), 0);
  EXPECT_EQ(mask(0, 0), 255);
  EXPECT_FALSE(fs::exists(this->Out() / "a0.png"));
}

TEST_F(ConvertDistorted, KeepsTheLensWhereTheFormatHoldsIt)
{
  this->Run(this->Options("opencv"));
  const DatasetIndex read = ReadDatasetIndex(this->Out());
  ExpectSamePhotographs(read.Cameras, this->Photographs, 1e-9);
  EXPECT_EQ(ReadText(read.Cameras[1].File), ReadText(this->In() / "images/sub/b1.jpg"));
}

TEST_F(ConvertDistorted, UndistortsWhereItDoesNotOrWhenAsked)
{
  ConvertOptions asked = this->Options("colmap");
  asked.Undistort = true;
  for (const ConvertOptions& options : { this->Options("middlebury"), asked })
  {
    SCOPED_TRACE(options.Format);
    fs::remove_all(this->Out());
    this->Run(options);
    const std::vector<Photograph> before = ReadDatasetIndex(this->In()).Cameras;
    const std::vector<Photograph> after = ReadDatasetIndex(this->Out()).Cameras;
    ASSERT_EQ(after.size(), before.size());
    EXPECT_EQ(after[1].Name, "sub/b1.png");
    for (std::size_t i = 0; i < 2; ++i)
    {
      // What the stages would see is the same, bit for bit.
      EXPECT_TRUE(after[i].Distortion.IsPinhole());
      EXPECT_EQ(ReadPhotograph(after[i], true, {}).Color.Values,
        ReadPhotograph(before[i], true, {}).Color.Values);
    }
    EXPECT_EQ(ReadPhotograph(after[1], false, {}).Mask.Values,
      ReadPhotograph(before[1], false, {}).Mask.Values);
  }
}

TEST_F(Convert, NothingIsWrittenWhenTheFormatCannotHoldACamera)
{
  this->Photographs[4].Cam.K(0, 0) += 1;
  WriteCalibration(this->In(), "colmap", this->Photographs);
  ExpectError([&] { this->Run(this->Options("bouguet")); }, "view a4.png", "one K");
  EXPECT_TRUE(this->Written().empty());
}

TEST_F(Convert, ABadPhotographLeavesNoDataSet)
{
  WriteText(this->In() / "images/a4.png", "no picture");
  ExpectError([&] { this->Run(this->Options("nerf")); }, "a4.png", "cannot be read as a picture");
  WritePicture(this->In() / "images/a4.png", 64, 48);
  ExpectError([&] { this->Run(this->Options("nerf")); }, "a4.png", "another size", "got 64x48");
  // Photographs may be there, whole; the calibration, which makes them a data set, is not.
  for (const std::string& name : this->Written())
  {
    EXPECT_TRUE(name.starts_with("images/") || name.starts_with("masks/")) << name;
    EXPECT_NE(fs::path(name).filename().string().front(), '.') << name;
  }
}

TEST_F(Convert, FoldersInUseAreRefused)
{
  ConvertOptions options = this->Options("nerf");
  options.Out = this->In() / "../in";
  EXPECT_THROW(this->Run(options), UsageError);
  ExpectError([&] { this->Run(options); }, "is the folder to read");
  this->Run(this->Options("nerf"));
  this->Run(this->Options("nerf")); // again is no harm
  ExpectError([&] { this->Run(this->Options("opencv")); }, "already contains another data set",
    "transforms.json");
}

TEST_F(Convert, PhotographsThatWouldBeOneFileAreRefused)
{
  this->Photographs[2].Name = "images/a0.png";
  WriteCalibration(this->In(), "colmap", this->Photographs);
  ExpectError(
    [&] { this->Run(this->Options("nerf")); }, "two photographs would be written as 'a0.png'");
}
