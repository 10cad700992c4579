// SPDX-License-Identifier: GPL-3.0-or-later
#include "Threads.h"
#include "ViewAccess.h"
#include "dataset/Dataset.h"
#include "formats/Middlebury.h"
#include "images/ImageFile.h"
#include "support/TestSupport.h"

#include <vtkImageData.h>

#include <cmath>

using namespace novelview;
using namespace novelview::testing_support;

namespace
{
constexpr int Width = 48;
constexpr int Height = 36;

/** A camera on a circle; every number of it has a full mantissa. */
Camera OnCircle(int i)
{
  const double a = 0.3 + i;
  Eigen::Matrix3d k;
  k << 501.0 / 7, 0, 70.0 / 3, 0, 502.0 / 7, 52.0 / 3, 0, 0, 1;
  return LookAt({ 3 * std::sin(a), 0.1 * i, 3 * std::cos(a) }, { 0, 0, 0 },
    Eigen::Vector3d::UnitY(), k, Width, Height);
}

std::string NameOf(int i)
{
  return "ball" + std::to_string(i) + ".png";
}

/** A bright disc, a little elsewhere in every picture, before a dark background. */
Image<std::uint8_t> Picture(int i)
{
  Image<std::uint8_t> picture(Width, Height, 3, 4);
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      if (std::hypot(x - 22 - i, y - 17) < 9)
      {
        picture(x, y, 0) = 200;
        picture(x, y, 1) = static_cast<std::uint8_t>(100 + 4 * x);
      }
    }
  }
  return picture;
}

/** A data set of three photographs, with masks or without. */
class Middlebury : public testing::Test
{
protected:
  void SetUp() override
  {
    std::vector<NamedCamera> cameras;
    for (int i = 0; i < 3; ++i)
    {
      WriteImageFile(this->Folder / NameOf(i), Picture(i).Ref());
      cameras.push_back({ NameOf(i), OnCircle(i) });
    }
    WriteCameras(this->ParFile(), cameras);
    this->Lines = Split(ReadText(this->ParFile()));
  }

  std::filesystem::path ParFile() const { return this->Folder / "ball_par.txt"; }
  Dataset Read(const DatasetOptions& options = {}) const
  {
    return ReadDataset(ReadDatasetIndex(this->Folder.Path), options);
  }
  /** Writes the calibration anew, with these line ends. */
  void WriteLines(const std::string& lineEnd = "\n") const
  {
    std::string text;
    for (const std::string& line : this->Lines)
    {
      text += line + lineEnd;
    }
    WriteText(this->ParFile(), text);
  }
  static std::vector<std::string> Split(const std::string& text)
  {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
    {
      lines.push_back(line);
    }
    return lines;
  }
  /** Replaces the n-th word of the line of the second photograph. */
  void ReplaceWord(int n, const std::string& word)
  {
    std::istringstream stream(this->Lines[2]);
    std::string line;
    int i = 0;
    for (std::string each; stream >> each; ++i)
    {
      line += (i > 0 ? " " : "") + (i == n ? word : each);
    }
    this->Lines[2] = line;
    this->WriteLines();
  }

  TemporaryFolder Folder;
  std::vector<std::string> Lines;
};
}

TEST_F(Middlebury, CalibrationReadsBackTheSameBits)
{
  const std::vector<NamedCamera> cameras = ReadCameras(this->ParFile());
  ASSERT_EQ(cameras.size(), 3u);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(cameras[i].Name, NameOf(i));
    EXPECT_EQ(cameras[i].Cam.K, OnCircle(i).K);
    EXPECT_EQ(cameras[i].Cam.R, OnCircle(i).R);
    EXPECT_EQ(cameras[i].Cam.T, OnCircle(i).T);
  }
}

TEST_F(Middlebury, DosLineEndsAndBlankLinesAreRead)
{
  this->Lines.insert(this->Lines.begin() + 2, "");
  this->Lines.emplace_back("  ");
  this->WriteLines("\r\n");
  const std::vector<NamedCamera> cameras = ReadCameras(this->ParFile());
  ASSERT_EQ(cameras.size(), 3u);
  EXPECT_EQ(cameras[2].Name, NameOf(2));
  EXPECT_EQ(cameras[2].Cam.T, OnCircle(2).T);
}

TEST_F(Middlebury, ViewsHoldWhatTheFilesSay)
{
  const Dataset dataset = this->Read();
  EXPECT_TRUE(dataset.Warnings.empty()) << dataset.Warnings.front();
  const std::vector<View> views =
    ReadViews(dataset.Views, { .Color = true, .Mask = true, .ContourDistance = true }, 3);
  ASSERT_EQ(views.size(), 3u);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(views[i].Name, NameOf(i));
    EXPECT_TRUE(views[i].Cam.R.isApprox(OnCircle(i).R, 1e-7)); // rounded to 2^-26 (CameraGrid)
    EXPECT_EQ(views[i].Cam.Width, Width);
    EXPECT_EQ(views[i].Color(20, 17, 1), Picture(i)(20, 17, 1));
    // The disc is nine pixels in radius; silhouettes from noiseless pictures are exact to a pixel.
    EXPECT_NEAR(views[i].ContourDistance(22 + i, 17), 9, 1);
    EXPECT_NEAR(views[i].ContourDistance(22 + i, 3), -5, 1);
    // 254 = area of the disc.
    EXPECT_NEAR(dataset.Coverages[i].Fraction * Width * Height, 254, 28); // half a pixel of rim
  }
}

TEST_F(Middlebury, MasksAreUsedWherePresent)
{
  Image<std::uint8_t> mask(Width, Height);
  mask(5, 6) = mask(6, 6) = mask(5, 7) = mask(6, 7) = 255;
  WriteImageFile(this->Folder / "mask/ball1.png", mask.Ref());
  const Dataset dataset = this->Read();
  const std::vector<View> views = ReadViews(dataset.Views, { .Mask = true });
  EXPECT_TRUE(views[1].IsObject(5, 6));
  EXPECT_FALSE(views[1].IsObject(23, 17));
  EXPECT_TRUE(views[0].IsObject(22, 17));
  // 4 of 1728 pixels is little, and two photographs had no mask: both are said.
  ASSERT_EQ(dataset.Warnings.size(), 2u);
  EXPECT_THAT(
    dataset.Warnings[0], testing::HasSubstr("view ball1.png: the silhouette covers 0.23 %"));
  EXPECT_THAT(dataset.Warnings[1], testing::HasSubstr("extracted: ball0.png, ball2.png"));
  DatasetOptions options;
  options.ForceSilhouettes = true;
  const Dataset forced = this->Read(options);
  EXPECT_TRUE(ReadViews(forced.Views, { .Mask = true })[1].IsObject(23, 17));
}

TEST_F(Middlebury, ExcludedPhotographsAreNotOpened)
{
  std::filesystem::remove(this->Folder / "ball1.png");
  DatasetOptions options;
  options.Exclude = { "ball1.png" };
  const Dataset dataset = this->Read(options);
  ASSERT_EQ(dataset.Views->GetNumberOfBlocks(), 2u);
  EXPECT_EQ(ViewName(dataset.Views, 1), "ball2.png");
  options.Exclude = { "bal1.png" };
  ExpectError([&] { this->Read(options); }, "no photograph of the name to exclude: bal1.png");
  options.Exclude = { "ball0.png", "ball1.png", "ball2.png" };
  ExpectError([&] { this->Read(options); }, "no photograph left");
}

TEST_F(Middlebury, AWrittenDataSetReadsBackTheSame)
{
  const Dataset first = this->Read();
  const TemporaryFolder other;
  WriteDataset(first.Views, other.Path, "copy");
  const Dataset second = ReadDataset(ReadDatasetIndex(other.Path));
  const ViewNeeds all{ .Color = true, .Mask = true, .ContourDistance = true };
  const std::vector<View> a = ReadViews(first.Views, all);
  const std::vector<View> b = ReadViews(second.Views, all);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_EQ(a[i].Name, b[i].Name);
    EXPECT_EQ(a[i].Cam.K, b[i].Cam.K);
    EXPECT_EQ(a[i].Cam.T, b[i].Cam.T);
    for (int y = 0; y < Height; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        ASSERT_EQ(a[i].Color(x, y, 1), b[i].Color(x, y, 1));
        ASSERT_EQ(a[i].Mask(x, y), b[i].Mask(x, y));
        ASSERT_EQ(a[i].ContourDistance(x, y), b[i].ContourDistance(x, y));
      }
    }
  }
}

TEST_F(Middlebury, ThreadsDoNotChangeTheResult)
{
  const Dataset many = this->Read();
  SetNumberOfThreads(1);
  const Dataset one = this->Read();
  SetNumberOfThreads(0);
  const auto a = ReadViews(many.Views, { .ContourDistance = true });
  const auto b = ReadViews(one.Views, { .ContourDistance = true });
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      ASSERT_EQ(a[2].ContourDistance(x, y), b[2].ContourDistance(x, y));
    }
  }
}

TEST_F(Middlebury, CalibrationToChooseIsNamed)
{
  const auto index = [this] { ReadDatasetIndex(this->Folder.Path); };
  ExpectError([&] { ReadDatasetIndex(this->Folder / "nowhere"); }, "nowhere", "no such folder");
  std::filesystem::copy_file(this->ParFile(), this->Folder / "other_par.txt");
  ExpectError(
    index, "several calibration files", "ball_par.txt (middlebury), other_par.txt (middlebury)");
  EXPECT_EQ(
    ReadDatasetIndex(this->Folder.Path, { this->Folder / "other_par.txt" }).Cameras.size(), 3u);
  std::filesystem::remove(this->ParFile());
  std::filesystem::remove(this->Folder / "other_par.txt");
  ExpectError(index, this->Folder.Path.string(), "no calibration file", "*_par.txt");
  ExpectError([&] { ReadDatasetIndex(this->Folder.Path, { this->Folder / "none.txt" }); },
    "none.txt", "no such file");
}

TEST_F(Middlebury, BadCalibrationIsNamedByFileAndLine)
{
  const auto read = [this] { ReadCameras(this->ParFile()); };
  const std::vector<std::string> good = this->Lines;
  this->Lines[0] = "4";
  this->WriteLines();
  ExpectError(read, "ball_par.txt", "count in line 1", "got 3, expected 4");
  this->Lines[0] = "three";
  this->WriteLines();
  ExpectError(read, "ball_par.txt, line 1", "not a count of photographs", "got 'three'");
  WriteText(this->ParFile(), "");
  ExpectError(read, "ball_par.txt", "empty");

  this->Lines = good;
  this->Lines[2] = this->Lines[2].substr(0, this->Lines[2].rfind(' '));
  this->WriteLines();
  ExpectError(read, "ball_par.txt, line 3", "line is short", "got 20 values", "expected 21");
  this->Lines[2] = good[2] + " 0.5";
  this->WriteLines();
  ExpectError(read, "ball_par.txt, line 3", "line is long", "got 22 values");

  this->Lines = good;
  this->ReplaceWord(4, "1,5");
  ExpectError(read, "ball_par.txt, line 3", "value 4 of ball1.png is not a number", "'1,5'");
  this->Lines = good;
  this->ReplaceWord(20, "nan");
  ExpectError(read, "ball_par.txt, line 3", "not finite");
  this->Lines = good;
  this->ReplaceWord(1, "0");
  ExpectError(read, "ball_par.txt, line 3 (ball1.png)", "K is singular");
  this->Lines = good;
  this->ReplaceWord(12, "0.1");
  ExpectError(read, "ball_par.txt, line 3 (ball1.png)", "R is not a rotation");
  this->Lines = good;
  this->Lines[3] = good[1];
  this->WriteLines();
  ExpectError(read, "ball_par.txt, line 4", "ball0.png is there twice");
}

TEST_F(Middlebury, BadPicturesAreNamed)
{
  const auto read = [this] { this->Read(); };
  WriteText(this->Folder / "ball2.png", "no picture");
  ExpectError(read, "ball2.png", "cannot be read as a picture");
  // With two bad ones it is always the first that is named.
  std::filesystem::remove(this->Folder / "ball1.png");
  ExpectError(read, "ball1.png", "no such file");

  WriteImageFile(this->Folder / "ball1.png", Picture(1).Ref());
  WriteImageFile(this->Folder / "ball2.png", Picture(2).Ref());
  WriteImageFile(this->Folder / "mask/ball1.png", Image<std::uint8_t>(20, 10, 1, 255).Ref());
  ExpectError(read, "mask/ball1.png", "another size", "got 20x10, expected 48x36");
  WriteImageFile(this->Folder / "mask/ball1.png", Image<std::uint8_t>(Width, Height).Ref());
  ExpectError(read, "view ball1.png", "silhouette is empty");
  WriteImageFile(this->Folder / "mask/ball1.png", Image<std::uint8_t>(Width, Height, 1, 255).Ref());
  ExpectError(read, "view ball1.png", "fills the whole frame");
}

TEST_F(Middlebury, NamesWithBlanksCannotBeWritten)
{
  ExpectError(
    [&] {
      WriteCameras(this->Folder / "b_par.txt", { { "a b.png", OnCircle(0) } });
    },
    "b_par.txt", "'a b.png'");
}

TEST(MiddleburyTemple, IsRead)
{
  const std::filesystem::path temple = SharedFolder() / "data" / "templeSparseRing";
  if (!std::filesystem::exists(temple))
  {
    GTEST_SKIP() << "needs the Middlebury data set templeSparseRing in " << temple;
  }
  DatasetOptions options;
  options.Exclude = { "templeSR0004.png" };
  const Dataset dataset = ReadDataset(ReadDatasetIndex(temple), options);
  EXPECT_EQ(dataset.Views->GetNumberOfBlocks(), 15u);
  const std::vector<View> views =
    ReadViews(dataset.Views, { .Color = true, .Mask = true, .ContourDistance = true });
  for (const View& view : views)
  {
    EXPECT_EQ(SizeText(view.Cam.Width, view.Cam.Height), "640x480");
    // The middle of the silhouette lies in the makers' bounding box of the temple,
    // (-0.074 0.022 -0.012) to (0.029 0.182 0.063), seen through the calibration.
    Eigen::AlignedBox2d box;
    for (int corner = 0; corner < 8; ++corner)
    {
      box.extend(view.Cam.Project({ corner & 1 ? 0.028855 : -0.073568,
        corner & 2 ? 0.181892 : 0.021728, corner & 4 ? 0.062736 : -0.012445 }));
    }
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double count = 0;
    for (int y = 0; y < 480; ++y)
    {
      for (int x = 0; x < 640; ++x)
      {
        if (view.IsObject(x, y))
        {
          sum += Eigen::Vector2d(x, y);
          count += 1;
        }
      }
    }
    EXPECT_TRUE(box.contains(sum / count)) << view.Name;
    // The silhouette of the box is some larger than the temple's in it.
    EXPECT_GT(count, 0.2 * box.volume()) << view.Name;
    EXPECT_LT(count, box.volume()) << view.Name;
  }
}
