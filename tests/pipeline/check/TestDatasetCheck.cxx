// SPDX-License-Identifier: GPL-3.0-or-later
// Every mistake that a check claims to find, planted in a small data set.
#include "Threads.h"
#include "check/CheckedPhotograph.h"
#include "check/DatasetCheck.h"
#include "commands/CheckCommand.h"
#include "images/OpenCvPixels.h"
#include "support/CheckScene.h"

#include <opencv2/imgproc.hpp>

#include <nlohmann/json.hpp>

using namespace novelview;
using namespace novelview::testing_support;
using support::Photo;
using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace
{
class DatasetCheck : public testing::Test
{
protected:
  CheckReport CheckWith(const std::vector<std::string>& options = {}) const
  {
    ParsedArguments given;
    for (std::size_t i = 0; i < options.size(); ++i)
    {
      const bool flag = i + 1 == options.size() || options[i + 1].starts_with("--");
      given.emplace_back(
        KeyOf(options[i]), std::vector<std::string>{ flag ? std::string("true") : options[i + 1] });
      i += flag ? 0 : 1;
    }
    Execution execution;
    execution.ParallelFor = ParallelFor;
    return CheckDataset(MakeCheckOptions(this->Folder.Path, given).Input, execution);
  }

  /** "--rotation-order" as "rotationOrder". */
  static std::string KeyOf(const std::string& flag)
  {
    std::string key;
    for (std::size_t i = 2; i < flag.size(); ++i)
    {
      key += flag[i] == '-' ? static_cast<char>(std::toupper(flag[++i])) : flag[i];
    }
    return key;
  }

  /** Writes photographs and checks them. */
  CheckReport Check(const std::vector<Photo>& photos, const WrittenAs& as = {}) const
  {
    WriteDataset(this->Folder.Path, photos, as);
    return this->CheckWith();
  }

  TemporaryFolder Folder;
};

/** "kind view" of every finding. */
std::vector<std::string> Kinds(const CheckReport& report)
{
  std::vector<std::string> kinds;
  for (const CheckFinding& finding : report.Findings)
  {
    kinds.push_back(finding.Kind + (finding.View.empty() ? "" : " " + finding.View));
  }
  return kinds;
}

/** Turns a camera about its own centre so that its picture moves by about this many pixels. */
void TurnCamera(Photo& photo, double pixels)
{
  const Eigen::Vector3d centre = photo.Cam.Centre();
  photo.Cam.R =
    Eigen::AngleAxisd(pixels / photo.Cam.K(0, 0), Eigen::Vector3d(0.6, 0.8, 0)).toRotationMatrix() *
    photo.Cam.R;
  photo.Cam.T = -(photo.Cam.R * centre);
}

void Blur(Photo& photo, double sigma)
{
  cv::Mat pixels = ToMat(std::as_const(photo.Color).Ref());
  cv::GaussianBlur(pixels, pixels, cv::Size(), sigma);
  photo.Color = FromMat<std::uint8_t>(pixels);
}

void Brighten(Photo& photo, double factor)
{
  cv::Mat pixels = ToMat(std::as_const(photo.Color).Ref());
  pixels *= factor;
  photo.Color = FromMat<std::uint8_t>(pixels);
}
}

TEST_F(DatasetCheck, ACleanDataSetHasNoFindings)
{
  for (const std::string format : { "middlebury", "nerf" })
  {
    SCOPED_TRACE(format);
    fs::remove_all(this->Folder.Path);
    const CheckReport report = this->Check(CleanPhotos(), { format });
    EXPECT_THAT(Kinds(report), ElementsAre());
    EXPECT_FALSE(report.HasProblems());
    // All but rounding at the silhouette boundary.
    EXPECT_GT(report.MeanIou, 0.995);
  }
}

TEST_F(DatasetCheck, EveryConventionMistakeIsNamedWithTheOptionsThatMendIt)
{
  struct Planted
  {
    WrittenAs As;
    std::vector<std::string> Options;
  };
  const std::vector<Planted> planted{
    { { "middlebury", { "opencv", "camera-to-world", "row", 0.0, false, false } },
      { "--poses", "camera-to-world" } },
    { { "middlebury", { "opengl", "world-to-camera", "row", 0.0, false, false } },
      { "--axes", "opengl" } },
    { { "middlebury", { "opencv", "world-to-camera", "column", 0.0, false, false } },
      { "--rotation-order", "column" } },
    { { "middlebury", { "opencv", "world-to-camera", "row", 0.0, true, false } }, { "--flip-y" } },
    { { "middlebury", { "opengl", "camera-to-world", "row", 0.0, false, false } },
      { "--axes", "opengl", "--poses", "camera-to-world" } },
    { { "middlebury", { "opencv", "camera-to-world", "column", 0.0, false, false } },
      { "--poses", "camera-to-world", "--rotation-order", "column" } },
    { { "middlebury", { "opengl", "world-to-camera", "column", 0.0, false, true } },
      { "--axes", "opengl", "--rotation-order", "column", "--invert-masks" } },
    { { "nerf", { "opencv", "camera-to-world", "row", 0.5, false, false } },
      { "--axes", "opencv" } },
    { { "colmap", { "opencv", "camera-to-world", "row", 0.5, false, false } },
      { "--poses", "camera-to-world" } },
  };
  for (const Planted& each : planted)
  {
    SCOPED_TRACE(each.As.Format + " " + testing::PrintToString(each.Options));
    fs::remove_all(this->Folder.Path);
    const CheckReport report = this->Check(CleanPhotos(), each.As);
    ASSERT_THAT(Kinds(report), ElementsAre("convention"));
    EXPECT_EQ(report.Findings[0].Severity, CheckSeverity::Error);
    EXPECT_EQ(report.Findings[0].Options, each.Options);
    EXPECT_GT(report.MeanIou, 0.995);
    EXPECT_THAT(Kinds(this->CheckWith(each.Options)), ElementsAre());
  }
}

TEST_F(DatasetCheck, AnOptionThatIsOneTooManyIsNamed)
{
  WriteDataset(this->Folder.Path, CleanPhotos());
  const CheckReport report = this->CheckWith({ "--poses", "camera-to-world" });
  ASSERT_THAT(Kinds(report), ElementsAre("convention"));
  EXPECT_THAT(report.Findings[0].Text, HasSubstr("without the options that change how it is read"));
  EXPECT_THAT(report.Findings[0].Options, ElementsAre());
}

TEST_F(DatasetCheck, InvertedMasksAreNamed)
{
  WrittenAs as;
  as.Convention.InvertMasks = true;
  const CheckReport report = this->Check(CleanPhotos(), as);
  ASSERT_THAT(Kinds(report), ElementsAre("mask-polarity"));
  EXPECT_THAT(report.Findings[0].Options, ElementsAre("--invert-masks"));
  EXPECT_THAT(report.Findings[0].Command, HasSubstr("--invert-masks"));
  EXPECT_THAT(Kinds(this->CheckWith({ "--invert-masks" })), ElementsAre());
}

TEST_F(DatasetCheck, PixelCentresAreClaimedWhereTheContoursShowThem)
{
  WrittenAs as;
  as.Convention.PixelCentre = 0.5;
  CheckReport report = this->Check(CleanPhotos(), as);
  ASSERT_THAT(Kinds(report), ElementsAre("pixel-centre"));
  EXPECT_THAT(report.Findings[0].Options, ElementsAre("--pixel-centre", "0.5"));
  EXPECT_EQ(report.Findings[0].Severity, CheckSeverity::Warning);
  EXPECT_THAT(Kinds(this->CheckWith({ "--pixel-centre", "0.5" })), ElementsAre());

  fs::remove_all(this->Folder.Path);
  as.Format = "colmap";
  as.Convention = ProjectConvention();
  report = this->Check(CleanPhotos(), as);
  ASSERT_THAT(Kinds(report), ElementsAre("pixel-centre"));
  EXPECT_THAT(report.Findings[0].Options, ElementsAre("--pixel-centre", "0"));
}

TEST_F(DatasetCheck, PixelCentresAreNotClaimedWhereNoiseHidesThem)
{
  std::vector<Photo> photos = CleanPhotos();
  for (std::size_t i = 0; i < photos.size(); ++i)
  {
    TurnCamera(photos[i], i % 3 == 0 ? 0.8 : -0.4);
  }
  WrittenAs as;
  as.Convention.PixelCentre = 0.5;
  EXPECT_THAT(Kinds(this->Check(photos, as)), ElementsAre());
}

TEST_F(DatasetCheck, SwappedMasksAreNamedBoth)
{
  std::vector<Photo> photos = CleanPhotos();
  std::swap(photos[2].Mask, photos[7].Mask);
  const CheckReport report = this->Check(photos);
  ASSERT_THAT(Kinds(report), ElementsAre("swapped p2.png", "swapped p7.png"));
  EXPECT_THAT(report.Findings[0].Text, HasSubstr("its mask and that of p7.png are swapped"));
  EXPECT_THAT(report.Findings[0].Options, ElementsAre("--exclude", "p2.png"));
  EXPECT_THAT(report.Findings[0].Command, HasSubstr("--exclude p2.png,p7.png"));
  EXPECT_GT(report.MeanIouAfter.value_or(0), 0.995);
}

TEST_F(DatasetCheck, SwappedPhotographsAreNamedBoth)
{
  std::vector<Photo> photos = CleanPhotos();
  std::swap(photos[3].Cam, photos[8].Cam);
  const CheckReport report = this->Check(photos);
  ASSERT_THAT(Kinds(report), ElementsAre("swapped p3.png", "swapped p8.png"));
  EXPECT_THAT(report.Findings[0].Text, HasSubstr("photographs and masks, or cameras"));
}

TEST_F(DatasetCheck, TheMaskOfAnotherPhotographIsNamed)
{
  std::vector<Photo> photos = CleanPhotos();
  photos[5].Mask = photos[1].Mask;
  const CheckReport report = this->Check(photos);
  ASSERT_THAT(Kinds(report), ElementsAre("mask-of-another p5.png"));
  EXPECT_THAT(report.Findings[0].Text, HasSubstr("that of p1.png"));
}

TEST_F(DatasetCheck, OneInvertedMaskIsNamed)
{
  std::vector<Photo> photos = CleanPhotos();
  for (std::uint8_t& value : photos[4].Mask.Values)
  {
    value = static_cast<std::uint8_t>(255 - value);
  }
  // As it is, the object also covers most of the frame and its border.
  const CheckReport report = this->Check(photos);
  EXPECT_THAT(Kinds(report), testing::Contains("mask-inverted p4.png"));
  for (const std::string& kind : Kinds(report))
  {
    EXPECT_THAT(kind, HasSubstr("p4.png"));
  }
}

TEST_F(DatasetCheck, AWrongMaskIsNamedByItsPhotograph)
{
  std::vector<Photo> photos = CleanPhotos();
  support::ShrinkSilhouette(photos[6], 3);
  CheckReport report = this->Check(photos);
  ASSERT_THAT(Kinds(report), ElementsAre("mask p6.png"));
  EXPECT_THAT(report.Findings[0].Text, HasSubstr("the silhouette that the photograph shows"));

  // One that is too large harms no other view, but holds what the object is not.
  photos = CleanPhotos();
  for (int y = 10; y < 50; ++y)
  {
    std::fill_n(photos[6].Mask.Values.begin() + y * 160 + 20, 30, std::uint8_t(255));
  }
  report = this->Check(photos);
  EXPECT_THAT(Kinds(report), ElementsAre("mask p6.png"));
}

TEST_F(DatasetCheck, AWrongCameraIsNamed)
{
  // Six pixels at an object of about 70 are the least that shows in any view; more shows better.
  for (const double pixels : { 6.0, 25.0 })
  {
    SCOPED_TRACE(pixels);
    std::vector<Photo> photos = CleanPhotos();
    TurnCamera(photos[9], pixels);
    const CheckReport report = this->Check(photos);
    ASSERT_THAT(Kinds(report), ElementsAre("camera p9.png"));
    EXPECT_TRUE(report.Agreement[9].Outlier);
    EXPECT_GT(report.MeanIouAfter.value_or(0), 0.99);
  }
}

TEST_F(DatasetCheck, APhotographOfSomethingElseIsNamed)
{
  std::vector<Photo> photos = CleanPhotos();
  const Photo other = support::Take(support::Box({ -0.2, -0.3, -0.2 }, { 0.2, 0.1, 0.3 }),
    support::Waves(0.1), photos[10].Cam, photos[10].Name);
  photos[10] = other;
  const CheckReport report = this->Check(photos);
  EXPECT_THAT(Kinds(report), ElementsAre("camera p10.png"));
}

TEST_F(DatasetCheck, CamerasThatAreWrongThroughoutAreNotBlamedOnOne)
{
  std::vector<Photo> photos = CleanPhotos();
  for (std::size_t i = 0; i < photos.size(); ++i)
  {
    TurnCamera(photos[i], i % 2 == 0 ? 30 : -30);
  }
  const CheckReport report = this->Check(photos);
  EXPECT_THAT(Kinds(report), ElementsAre("inconsistent"));
}

TEST_F(DatasetCheck, ABlurredPhotographIsNamed)
{
  for (const double sigma : { 1.5, 4.0 })
  {
    std::vector<Photo> photos = CleanPhotos();
    Blur(photos[3], sigma);
    EXPECT_THAT(Kinds(this->Check(photos)), ElementsAre("blurred p3.png")) << sigma;
  }
}

TEST_F(DatasetCheck, WrongExposuresAreNamed)
{
  std::vector<Photo> photos = CleanPhotos();
  Brighten(photos[3], 2.2);
  CheckReport report = this->Check(photos);
  EXPECT_THAT(Kinds(report), ElementsAre("overexposed p3.png", "clipped p3.png"));
  photos = CleanPhotos();
  Brighten(photos[5], 0.4);
  report = this->Check(photos);
  EXPECT_THAT(Kinds(report), ElementsAre("underexposed p5.png"));
}

TEST_F(DatasetCheck, AnObjectThatLeavesTheFrameIsNamedWithItsSides)
{
  std::vector<Photo> photos = CleanPhotos();
  Eigen::Matrix3d k = photos[2].Cam.K;
  k(0, 2) = 20;
  photos[2].Cam.K = k;
  const support::Shape object = support::Sphere({ 0.02, -0.05, 0.03 }, 0.3);
  // All photographs of a ball, one of them aimed beside it.
  for (Photo& photo : photos)
  {
    photo = support::Take(object, support::Waves(0.12), photo.Cam, photo.Name);
  }
  const CheckReport report = this->Check(photos);
  ASSERT_THAT(Kinds(report), ElementsAre("border p2.png"));
  EXPECT_THAT(report.Findings[0].Text, HasSubstr("leaves the frame (left)"));
}

TEST_F(DatasetCheck, APhotographResizedAfterItsCalibrationIsAnError)
{
  WriteDataset(this->Folder.Path, CleanPhotos());
  const Photo& photo = CleanPhotos()[3];
  WriteImageFile(this->Folder / photo.Name, ReducedImage(photo.Color.Ref(), 80, 60).Ref());
  WriteImageFile(this->Folder / "mask" / photo.Name, ReducedImage(photo.Mask.Ref(), 80, 60).Ref());
  const CheckReport report = this->CheckWith();
  ASSERT_FALSE(report.Findings.empty());
  EXPECT_EQ(report.Findings[0].Kind, "size");
  EXPECT_THAT(report.Findings[0].Text, HasSubstr("another size than p0.png, whose K is the same"));
}

TEST_F(DatasetCheck, PhotographsThatRunWillReduceAreANote)
{
  WriteDataset(this->Folder.Path, CleanPhotos());
  DatasetInput input;
  input.Dataset = this->Folder.Path;
  input.MaxSize = 100;
  const CheckReport report = CheckDataset(input);
  EXPECT_THAT(Kinds(report), ElementsAre("size"));
  EXPECT_FALSE(report.HasProblems());
}

TEST_F(DatasetCheck, MissingMasksAreNamed)
{
  std::vector<Photo> photos = CleanPhotos();
  photos[1].Mask = {};
  photos[8].Mask = {};
  CheckReport report = this->Check(photos);
  EXPECT_THAT(Kinds(report), ElementsAre("mask-missing p1.png", "mask-missing p8.png"));
  // A mask that is there under a name that no reader looks for.
  WriteImageFile(this->Folder / "mask/p1-object.png", std::as_const(CleanPhotos()[1].Mask).Ref());
  report = this->CheckWith();
  ASSERT_THAT(
    Kinds(report), ElementsAre("mask-unused", "mask-missing p1.png", "mask-missing p8.png"));
  EXPECT_THAT(report.Findings[0].Text, HasSubstr("by their names: mask/p1-object.png"));
}

TEST_F(DatasetCheck, WithoutAnyMaskThatIsANote)
{
  WrittenAs as;
  as.Masks = false;
  const CheckReport report = this->Check(CleanPhotos(), as);
  EXPECT_THAT(Kinds(report), ElementsAre("mask-missing"));
  EXPECT_FALSE(report.HasProblems());
}

TEST_F(DatasetCheck, FilesThatDoNotFitAreNamedAllAtOnce)
{
  WriteDataset(this->Folder.Path, CleanPhotos());
  WriteText(this->Folder / "p0.png", "no picture");
  WriteImageFile(this->Folder / "mask/p4.png", Image<std::uint8_t>(80, 60, 1, 255).Ref());
  WriteImageFile(this->Folder / "mask/p6.png", Image<std::uint8_t>(160, 120, 1, 0).Ref());
  const CheckReport report = this->CheckWith();
  EXPECT_THAT(Kinds(report), ElementsAre("file p0.png", "file p4.png", "empty-mask p6.png"));
  EXPECT_THAT(report.Findings[0].Text, HasSubstr("cannot be read as a picture"));
  EXPECT_THAT(report.Findings[1].Text, HasSubstr("mask is 80x60, the photograph is 160x120"));
  // The others are compared all the same.
  EXPECT_GT(report.Agreement[1].Iou, 0.99);
  EXPECT_FALSE(report.Agreement[0].TakesPart);
}

TEST_F(DatasetCheck, NothingToExamineIsAnError)
{
  ExpectError([&] { this->CheckWith(); }, "no calibration file");
}

TEST_F(DatasetCheck, TableAndJsonTellEverything)
{
  std::vector<Photo> photos = CleanPhotos();
  std::swap(photos[2].Mask, photos[7].Mask);
  const CheckReport report = this->Check(photos);
  const std::vector<std::string> table = CheckTable(report);
  const auto json = nlohmann::json::parse(CheckJson(report));
  // Three lines about files, a heading, the views, the mean, the findings.
  EXPECT_EQ(table.size(), 3 + 1 + photos.size() + 1 + report.Findings.size());
  EXPECT_THAT(table.back(), HasSubstr("swapped"));
  EXPECT_EQ(json["views"].size(), photos.size());
  EXPECT_EQ(json["problems"], true);
  EXPECT_EQ(json["findings"].size(), 2u);
  EXPECT_EQ(json["findings"][0]["view"], "p2.png");
  EXPECT_EQ(json["conventions"].size(), 16u);
  EXPECT_EQ(json["views"][2]["blamed"], true);
  EXPECT_TRUE(json["views"][2]["hullIouWithoutBlamed"].is_null());
}

TEST(CheckedPhotograph, OutliersAreFurtherOffThanTheOthersSpread)
{
  using Ids = std::vector<std::size_t>;
  EXPECT_EQ(FindOutliers({ 1, 1.01, 0.99, 1, 0.5, 2 }, 1.4, {}), (Ids{ 4, 5 }));
  EXPECT_EQ(FindOutliers({ 1, 1.01, 0.99, 1, 0.5, 2 }, 1.4, { true, false }), Ids{ 4 });
  // The factor keeps small differences in a set of nearly equals from standing out.
  EXPECT_EQ(FindOutliers({ 1, 1, 1, 1, 0.8 }, 1.4, {}), Ids{});
  // The spread keeps large ones where all differ.
  EXPECT_EQ(FindOutliers({ 1, 1.5, 0.6, 2, 0.5, 1.2 }, 1.4, {}), Ids{});
  EXPECT_EQ(FindOutliers({ 1, 1, 0, 1 }, 1.4, {}), Ids{}) << "0 is unknown";
}

TEST(CheckedPhotograph, SharpnessFallsWithBlurAndNotWithContrast)
{
  const Photo& photo = CleanPhotos().front();
  const auto sharpness = [](const Photo& of)
  { return MeasureSharpness(std::as_const(of.Color).Ref(), std::as_const(of.Mask).Ref()); };
  Photo dim = photo;
  Brighten(dim, 0.5);
  Photo blurred = photo;
  Blur(blurred, 2);
  // Rounding alone distinguishes the dim one from the original; a blur of two pixels leaves little
  // that is finer than one (measured 0.51 of it; 0.71 would be named).
  EXPECT_NEAR(sharpness(dim), sharpness(photo), 0.05 * sharpness(photo));
  EXPECT_LT(sharpness(blurred), 0.6 * sharpness(photo));
}
