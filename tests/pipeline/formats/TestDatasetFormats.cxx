// SPDX-License-Identifier: GPL-3.0-or-later
#include "ViewAccess.h"
#include "cameras/MaskFiles.h"
#include "support/CalibrationCases.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>

using namespace novelview;
using namespace novelview::testing_support;
using testing::ElementsAre;
using testing::HasSubstr;

namespace
{
const std::vector<std::string> All{ "middlebury", "colmap", "colmap-binary", "nerf", "opencv",
  "bouguet" };

/** Through one format and then another one. */
void ExpectRoundTrip(
  const std::vector<Photograph>& photographs, const std::string& first, const std::string& second)
{
  SCOPED_TRACE(first + " to " + second);
  const TemporaryFolder a;
  const TemporaryFolder b;
  WriteCalibration(a.Path, first, photographs);
  std::vector<Photograph> between = ReadDatasetIndex(a.Path, { .Format = first }).Cameras;
  for (std::size_t i = 0; i < between.size(); ++i)
  {
    between[i].Cam.Width = photographs[i].Cam.Width; // not in a Middlebury file
    between[i].Cam.Height = photographs[i].Cam.Height;
  }
  WriteCalibration(b.Path, second, between);
  const DatasetIndex read = ReadDatasetIndex(b.Path);
  EXPECT_TRUE(read.Format == second || second == "colmap-binary") << read.Format;
  // Numbers around 1000: 1e-9 leaves room for rounding in the quaternions and rotation vectors only.
  ExpectSamePhotographs(read.Cameras, photographs, 1e-9);
}

/** A disc in one channel of a picture. */
void DrawDisc(Image<std::uint8_t>& picture, double x0, double y0, double radius, std::uint8_t value)
{
  for (int y = 0; y < picture.Height; ++y)
  {
    for (int x = 0; x < picture.Width; ++x)
    {
      for (int channel = 0; channel < picture.Channels && std::hypot(x - x0, y - y0) < radius;
           ++channel)
      {
        picture(x, y, channel) = value;
      }
    }
  }
}

/** A data set of one photograph, a bright disc at (20, 15) before black, in OpenCV's format. */
class OnePhotograph
{
public:
  explicit OnePhotograph(const Lens& lens = {})
  {
    Image<std::uint8_t> picture(48, 36, 3);
    DrawDisc(picture, 20, 15, 8, 200);
    WriteImageFile(this->Folder / "a.png", picture.Ref());
    Photograph photograph;
    photograph.Name = "a.png";
    photograph.Distortion = lens;
    photograph.Cam.K << 50, 0, 23.5, 0, 50, 17.5, 0, 0, 1;
    photograph.Cam.Width = 48;
    photograph.Cam.Height = 36;
    WriteCalibration(this->Folder.Path, "opencv", { photograph });
  }
  /** A mask with a disc at (30, 20). */
  void WriteMask(const std::string& name, bool inverted = false) const
  {
    Image<std::uint8_t> mask(48, 36, 1, inverted ? 255 : 0);
    DrawDisc(mask, 30, 20, 5, inverted ? 0 : 255);
    WriteImageFile(this->Folder / name, mask.Ref());
  }
  /** Gives the photograph an alpha channel with a disc at (10, 10). */
  void AddAlpha(int opaque) const
  {
    const std::string path = (this->Folder / "a.png").string();
    const cv::Mat color = cv::imread(path);
    cv::Mat whole(color.rows, color.cols, CV_8UC4);
    for (int y = 0; y < color.rows; ++y)
    {
      for (int x = 0; x < color.cols; ++x)
      {
        const auto& c = color.at<cv::Vec3b>(y, x);
        const bool inside = std::hypot(x - 10, y - 10) < 4;
        whole.at<cv::Vec4b>(y, x) = cv::Vec4b(c[0], c[1], c[2], inside ? 255 : opaque);
      }
    }
    cv::imwrite(path, whole);
  }
  View Read(const DatasetSource& source = {}, bool force = false)
  {
    DatasetOptions options;
    options.ForceSilhouettes = force;
    this->Data = ReadDataset(ReadDatasetIndex(this->Folder.Path, source), options);
    return ReadViews(this->Data.Views, { .Color = true, .Mask = true }).front();
  }

  TemporaryFolder Folder;
  Dataset Data;
};
}

TEST(DatasetFormats, CamerasGoThroughEveryPairUnchanged)
{
  const std::vector<Photograph> photographs = RandomPhotographs(11, true, {});
  for (const std::string& first : All)
  {
    for (const std::string& second : All)
    {
      ExpectRoundTrip(photographs, first, second);
    }
  }
}

TEST(DatasetFormats, CamerasOfTheirOwnGoThroughAllButBouguets)
{
  const std::vector<Photograph> photographs = RandomPhotographs(12, false, {});
  for (const char* first : { "middlebury", "colmap", "colmap-binary", "nerf", "opencv" })
  {
    for (const char* second : { "middlebury", "colmap", "colmap-binary", "nerf", "opencv" })
    {
      ExpectRoundTrip(photographs, first, second);
    }
  }
}

TEST(DatasetFormats, SkewGoesThroughThoseThatHaveIt)
{
  const std::vector<Photograph> photographs = RandomPhotographs(13, true, {}, 3.25);
  for (const char* first : { "middlebury", "opencv", "bouguet" })
  {
    for (const char* second : { "middlebury", "opencv", "bouguet" })
    {
      ExpectRoundTrip(photographs, first, second);
    }
  }
}

TEST(DatasetFormats, LensesGoThroughThoseThatHoldThem)
{
  const Lens brown{ Lens::Model::Perspective, { 0.1, -0.02, 0.003, -0.004 } };
  const Lens third{ Lens::Model::Perspective, { 0.1, -0.02, 0.003, -0.004, 0.01 } };
  const Lens rational{ Lens::Model::Perspective, { 0.1, -0.02, 0.003, -0.004, 0.01, 0.1, 0, 0.2 } };
  const Lens prism{ Lens::Model::Perspective, { 0, 0, 0, 0, 0, 0, 0, 0, 0.1, 0, 0, 0.2 } };
  const Lens fisheye{ Lens::Model::Fisheye, { 0.1, -0.02, 0.003, -0.004 } };
  const Lens equidistant{ Lens::Model::Fisheye, {} };
  const std::vector<std::pair<Lens, std::vector<std::string>>> cases{
    { brown, { "colmap", "colmap-binary", "nerf", "opencv", "bouguet" } },
    { third, { "colmap", "colmap-binary", "nerf", "opencv", "bouguet" } },
    { rational, { "colmap", "colmap-binary", "opencv" } },
    { prism, { "opencv" } },
    { fisheye, { "colmap", "colmap-binary", "nerf", "opencv" } },
    { equidistant, { "colmap", "colmap-binary", "nerf", "opencv" } },
  };
  for (const auto& [lens, holders] : cases)
  {
    const std::vector<Photograph> photographs = RandomPhotographs(14, true, lens);
    std::vector<std::string> found;
    for (const std::string& format : All)
    {
      if (std::all_of(photographs.begin(), photographs.end(), FormatOf(format).HoldsLens))
      {
        found.push_back(format);
      }
    }
    EXPECT_EQ(found, holders);
    for (const std::string& first : holders)
    {
      for (const std::string& second : holders)
      {
        ExpectRoundTrip(photographs, first, second);
      }
    }
  }
}

TEST(DatasetFormats, NothingFoundSaysWhatWasLookedFor)
{
  const TemporaryFolder folder;
  ExpectError([&] { ReadDatasetIndex(folder.Path); }, folder.Path.string(), "no calibration file",
    "*_par.txt (middlebury)", "sparse/0/ (colmap)", "transforms.json", "*.yml, *.yaml or *.xml",
    "Calib_Results.m (bouguet)");
  WriteCalibration(folder.Path, "nerf", RandomPhotographs(1, true, {}));
  ExpectError([&] { ReadDatasetIndex(folder.Path, { .Format = "bouguet" }); },
    "no calibration file", "got none, expected one of Calib_Results.m (bouguet)");
  ExpectError([&] { ReadDatasetIndex(folder.Path, { folder / "cameras.dat" }); }, "cameras.dat",
    "is not a calibration that is recognised by its name");
}

TEST(DatasetFormats, SeveralFoundAreNamedAndOneCanBeChosen)
{
  const TemporaryFolder folder;
  WriteCalibration(folder.Path, "nerf", RandomPhotographs(1, true, {}));
  WriteCalibration(folder.Path, "bouguet", RandomPhotographs(2, true, {}));
  WriteCalibration(folder.Path, "colmap", RandomPhotographs(3, true, {}));
  ExpectError([&] { ReadDatasetIndex(folder.Path); }, "several calibration files", "--format",
    "sparse/0/images.txt (colmap), transforms.json (nerf), Calib_Results.m (bouguet)");
  EXPECT_EQ(ReadDatasetIndex(folder.Path, { .Format = "colmap" }).Format, "colmap");
  EXPECT_EQ(ReadDatasetIndex(folder.Path, { folder / "transforms.json" }).Format, "nerf");
  // A name without a known extension is read in the format that is given.
  std::filesystem::rename(folder / "Calib_Results.m", folder / "mine.txt");
  DatasetSource source{ folder / "mine.txt", "bouguet" };
  ExpectSamePhotographs(
    ReadDatasetIndex(folder.Path, source).Cameras, RandomPhotographs(2, true, {}), 1e-9);
  ExpectError([] { FormatOf("agisoft"); }, "unknown", "'agisoft'", "middlebury, colmap");
}

TEST(PhotographFiles, MasksAreFoundByEveryUsualName)
{
  for (const char* name : { "mask/sub/a.jpg", "mask/sub/a.png", "masks/sub/a.jpg.png",
         "silhouettes/sub/a_mask.png", "masks/sub/a.mask.png", "sub/a.jpg.png", "sub/a_mask.png",
         "sub/a.mask.png", "mask/sub/a.PNG", "masks/sub/a.tif", "mask/sub/a.pgm", "masks/sub/a.bmp",
         "Masks/sub/a.png", "sub/a.jpg.mask.png", "sub/a.jpg_mask.png", "segmentation/sub/a.png",
         "mask/images/sub/a.png", "silhouettes/sub/A.png" })
  {
    const TemporaryFolder folder;
    WriteFile(folder / "sub/a.jpg", "");
    WriteFile(folder / "sub/a.png", ""); // another photograph, no mask
    EXPECT_EQ(MaskFileOf(folder.Path, "sub/a.jpg"), "");
    WriteFile(folder / name, "");
    EXPECT_EQ(MaskFileOf(folder.Path, "sub/a.jpg"), folder / name);
    EXPECT_EQ(MaskFileOf(folder.Path, "sub/b.jpg"), "");
  }
}

TEST(PhotographFiles, PathsOfOtherComputersLeadToTheFilesThatAreMeant)
{
  const TemporaryFolder folder;
  WriteFile(folder / "images/sub/a.png", "");
  WriteFile(folder / "b.PNG", "");
  WriteFile(folder / "c.png", "");
  WriteFile(folder / "C.png", "");
  EXPECT_EQ(FileMeant(folder.Path, "images\\sub\\a.png"), folder / "images/sub/a.png");
  EXPECT_EQ(
    FileMeant(folder.Path, "C:\\Users\\x\\images\\sub\\a.png"), folder / "images/sub/a.png");
  EXPECT_EQ(FileMeant(folder.Path, "/home/x/data/b.png"), folder / "b.PNG");
  EXPECT_EQ(FileMeant(folder.Path, "../b.png"), folder / "b.PNG");
  EXPECT_EQ(FileMeant(folder.Path, "c.PNG"), "") << "two files fit";
  EXPECT_EQ(FileMeant(folder.Path, "other/b.png"), "") << "another folder's photograph";
}

TEST(DatasetFormats, ByteOrderMarksBackslashesAndCaseOfLettersAreSeenThrough)
{
  const TemporaryFolder folder;
  WriteFile(folder / "Sparse/0/Cameras.txt",
    "\xef\xbb\xbf"
    "1 PINHOLE 2 2 1 1 1 1\n");
  WriteFile(folder / "Sparse/0/Images.txt",
    "\xef\xbb\xbf"
    "1 1 0 0 0 0 0 1 1 sub\\a.png\n\n");
  WriteFile(folder / "images/sub/a.PNG", "");
  DatasetIndex index = ReadDatasetIndex(folder.Path, { folder / "Sparse/0/Cameras.txt" });
  ASSERT_EQ(index.Cameras.size(), 1u);
  EXPECT_EQ(index.Cameras[0].File, folder / "images/sub/a.PNG");
  ASSERT_EQ(index.Notes.size(), 1u);
  EXPECT_THAT(index.Notes[0].Text, HasSubstr("1 files have other names than in the calibration"));
  std::filesystem::rename(folder / "Sparse", folder / "sparse");
  EXPECT_EQ(ReadDatasetIndex(folder.Path).Cameras.size(), 1u);
  WriteFile(folder / "sparse/0/Images.txt",
    "\xff\xfe"
    "1");
  ExpectError([&] { ReadDatasetIndex(folder.Path); }, "Images.txt", "got UTF-16", "UTF-8");
}

TEST(PhotographFiles, MasksThatAreNotUsedAreToldOf)
{
  const TemporaryFolder folder;
  for (const char* name : { "mask/a.png", "mask/stray.png", "object_masks/a.png", "mask/notes.txt",
         "mask/contact-sheet.png" })
  {
    WriteFile(folder / name, "");
  }
  MaskFiles masks(folder.Path);
  EXPECT_EQ(masks.Of("a.jpg"), folder / "mask/a.png");
  EXPECT_THAT(masks.Unused(), ElementsAre(folder / "mask/stray.png"));
  EXPECT_THAT(masks.UnreadFolders(), ElementsAre(folder / "object_masks"));
}

TEST(PhotographFiles, AreListedInNaturalOrderWithoutMasks)
{
  const TemporaryFolder folder;
  for (const char* name : { "v10.png", "v9.png", "v09.png", "a.JPG", "v9_mask.png", "a.JPG.png",
         "v10.mask.png", "notes.txt", "b2.tif", "b2x.tif" })
  {
    WriteFile(folder / name, "");
  }
  EXPECT_THAT(PhotographsIn(folder.Path),
    ElementsAre("a.JPG", "b2.tif", "b2x.tif", "v09.png", "v9.png", "v10.png"));
}

TEST(PhotographFiles, NamesStayInTheFolder)
{
  EXPECT_EQ(NameOfFile("./images/../images/a.png"), "a.png");
  EXPECT_EQ(NameOfFile("images/images/a.png"), "a.png");
  EXPECT_EQ(NameOfFile("../other/a.png"), "other/a.png");
  EXPECT_EQ(NameOfFile("/data/a.png"), "data/a.png");
  EXPECT_EQ(NameOfFile("train/a.png"), "train/a.png");
}

TEST(DatasetMasks, AFileGoesBeforeAlphaAndAlphaBeforeExtraction)
{
  OnePhotograph data;
  EXPECT_TRUE(data.Read().IsObject(20, 15));
  data.AddAlpha(0);
  View view = data.Read();
  EXPECT_TRUE(view.IsObject(10, 10));
  EXPECT_FALSE(view.IsObject(20, 15));
  EXPECT_EQ(view.Color(20, 15, 0), 200); // colours stay, also where they are transparent
  data.WriteMask("masks/a.png.png");
  view = data.Read();
  EXPECT_TRUE(view.IsObject(30, 20));
  EXPECT_FALSE(view.IsObject(10, 10));
  EXPECT_TRUE(data.Read({}, true).IsObject(20, 15));
}

TEST(DatasetMasks, OpaqueAlphaIsNoMask)
{
  OnePhotograph data;
  data.AddAlpha(255);
  const View view = data.Read();
  EXPECT_TRUE(view.IsObject(20, 15));
  EXPECT_FALSE(view.IsObject(10, 10));
}

TEST(DatasetMasks, CanBeTheOtherWayRound)
{
  OnePhotograph data;
  data.WriteMask("mask/a.png", true);
  EXPECT_FALSE(data.Read().IsObject(30, 20));
  DatasetSource source;
  source.Convention.InvertMasks = true;
  const View view = data.Read(source);
  EXPECT_TRUE(view.IsObject(30, 20));
  EXPECT_FALSE(view.IsObject(20, 15));
  // What is extracted from the photograph has no polarity.
  std::filesystem::remove_all(data.Folder / "mask");
  EXPECT_TRUE(data.Read(source).IsObject(20, 15));
}

TEST(DatasetPixels, AreUndistortedWithTheirMasks)
{
  // A barrel shows things nearer to the middle than a pinhole would.
  const Lens lens{ Lens::Model::Perspective, { -1.5 } };
  OnePhotograph data(lens);
  const Photograph photograph = ReadDatasetIndex(data.Folder.Path).Cameras.front();
  Eigen::Vector2d straight(12, 12); // a pixel whose distorted place lies in the disc
  const Eigen::Vector2d seen = Distort(lens, photograph.Cam.K, straight);
  ASSERT_LT((seen - Eigen::Vector2d(20, 15)).norm(), 8);
  ASSERT_GT((straight - Eigen::Vector2d(20, 15)).norm(), 8);
  View view = data.Read();
  EXPECT_EQ(view.Color(12, 12, 0), 200);
  EXPECT_TRUE(view.IsObject(12, 12));
  data.WriteMask("masks/a.png.png");
  view = data.Read();
  EXPECT_FALSE(view.IsObject(12, 12));
  EXPECT_EQ(view.Cam.K, photograph.Cam.K);
}

TEST(DatasetPixels, SizesMustAgreeWithTheCalibration)
{
  OnePhotograph data;
  WritePicture(data.Folder / "a.png", 24, 18);
  ExpectError([&] { data.Read(); }, "a.png", "photograph has another size than its calibration",
    "got 24x18, expected 48x36");
}
