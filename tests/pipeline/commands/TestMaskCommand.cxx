// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/UsageError.h"
#include "commands/MaskCommand.h"
#include "dataset/Dataset.h"
#include "images/ImageFile.h"
#include "images/OpenCvPixels.h"
#include "masks/GrabCutMask.h"
#include "masks/MaskSheet.h"
#include "support/TestSupport.h"

#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <functional>
#include <random>

using namespace novelview;
using namespace novelview::testing_support;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace
{
using Rgb = std::array<double, 3>;

/** A picture whose object is known: a lying pear, somewhat off the middle. */
struct KnownPicture
{
  Image<std::uint8_t> Color{ 160, 120, 3 };
  Image<std::uint8_t> Truth{ 160, 120 };
};

bool InPear(double x, double y)
{
  return std::hypot(x - 70, y - 62) < 26 || std::hypot(x - 104, y - 56) < 15;
}

/** Colours by pixel, with noise of 3 levels; `seed` draws it. */
KnownPicture Paint(const std::function<Rgb(int x, int y)>& object,
  const std::function<Rgb(int x, int y)>& background, unsigned int seed = 1)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 3);
  KnownPicture picture;
  for (int y = 0; y < 120; ++y)
  {
    for (int x = 0; x < 160; ++x)
    {
      const bool inside = InPear(x, y);
      picture.Truth(x, y) = inside ? 255 : 0;
      const Rgb colour = inside ? object(x, y) : background(x, y);
      for (int channel = 0; channel < 3; ++channel)
      {
        picture.Color(x, y, channel) = static_cast<std::uint8_t>(
          std::lround(std::clamp(colour[channel] + noise(random), 0.0, 255.0)));
      }
    }
  }
  return picture;
}

Rgb Wooden(int x, int y)
{
  const double grain = 25 * std::sin(0.5 * x + 0.1 * y);
  return { 150 + grain, 105 + grain, 70 + 0.5 * grain };
}

/** Green cloth, in light that falls to less than half from left to right. */
Rgb UnevenGreen(int x, int)
{
  const double light = 1 - 0.55 * x / 159;
  return { 40 * light, 190 * light, 60 * light };
}

// The pear's outline is about 210 pixels long and its area 2700: an IoU of 0.96 is a mask that is
// off by half a pixel all around.
constexpr double HalfPixelIou = 0.96;

class MaskCommand : public testing::Test
{
protected:
  fs::path In() const { return this->Folder / "in"; }
  fs::path Out() const { return this->Folder / "out"; }
  MaskOptions Options(const std::string& method) const
  {
    MaskOptions options;
    options.Dataset = this->In();
    options.Out = this->Out();
    options.Method = method;
    return options;
  }
  void Write(const std::string& name, const KnownPicture& picture) const
  {
    WriteImageFile(this->In() / name, picture.Color.Ref());
  }
  /** RGB and the truth as alpha. */
  void WriteWithAlpha(const std::string& name, const KnownPicture& picture) const
  {
    cv::Mat pixels(120, 160, CV_8UC4);
    for (int y = 0; y < 120; ++y)
    {
      for (int x = 0; x < 160; ++x)
      {
        pixels.at<cv::Vec4b>(y, x) = { picture.Color(x, y, 2), picture.Color(x, y, 1),
          picture.Color(x, y, 0), picture.Truth(x, y) };
      }
    }
    fs::create_directories(this->In());
    cv::imwrite((this->In() / name).string(), pixels);
  }
  void Run(const MaskOptions& options) const
  {
    Console console(Verbosity::Quiet);
    WriteMasks(options, console);
  }
  /** The IoU of the mask that a method makes of one picture. */
  double Made(const KnownPicture& picture, const MaskOptions& options) const
  {
    this->Write("a.png", picture);
    return IouOf(MaskOf(this->In() / "a.png", options), picture.Truth);
  }

  TemporaryFolder Folder;
};
}

TEST_F(MaskCommand, ChromaSeesThroughUnevenLight)
{
  const KnownPicture picture = Paint(Wooden, UnevenGreen);
  EXPECT_GT(this->Made(picture, this->Options("chroma")), HalfPixelIou);
  MaskOptions keyed = this->Options("chroma");
  keyed.Key = { 40, 190, 60 };
  EXPECT_GT(this->Made(picture, keyed), HalfPixelIou);
  // Which is more than the difference from one background colour sees: the test is one.
  MaskOptions plain = this->Options("plain");
  plain.Silhouette.IgnoreShadows = false;
  EXPECT_LT(this->Made(picture, plain), 0.9);
}

TEST_F(MaskCommand, ChromaKeepsGreyAndBlackObjects)
{
  for (const double grey : { 10.0, 128.0, 240.0 })
  {
    const KnownPicture picture = Paint(
      [grey](int, int) {
        return Rgb{ grey, grey, grey };
      },
      [](int, int) {
        return Rgb{ 40, 190, 60 };
      });
    EXPECT_GT(this->Made(picture, this->Options("chroma")), HalfPixelIou) << grey;
  }
}

TEST_F(MaskCommand, ChromaNeedsAHue)
{
  this->Write("a.png", Paint(Wooden, [](int, int) { return Rgb{ 120, 120, 118 }; }));
  ExpectError([&] { this->Run(this->Options("chroma")); }, "a.png", "no hue", "chroma");
  MaskOptions keyed = this->Options("chroma");
  keyed.Key = { 90, 90, 90 };
  ExpectError([&] { this->Run(keyed); }, "no hue that distinguishes the object");
  EXPECT_FALSE(fs::exists(this->Out() / "mask")) << "nothing is written";
}

TEST_F(MaskCommand, PlainAndDarkBackgrounds)
{
  const auto dark = [](int, int) { return Rgb{ 12, 12, 14 }; };
  const auto blue = [](int, int) { return Rgb{ 50, 70, 160 }; };
  EXPECT_GT(this->Made(Paint(Wooden, dark), this->Options("plain")), HalfPixelIou);
  EXPECT_GT(this->Made(Paint(Wooden, blue), this->Options("plain")), HalfPixelIou);
  EXPECT_GT(this->Made(Paint(Wooden, dark), this->Options("dark")), HalfPixelIou);
  this->Write("a.png", Paint(Wooden, [](int, int) { return Rgb{ 200, 200, 210 }; }));
  ExpectError([&] { this->Run(this->Options("dark")); }, "a.png",
    "nothing along the photograph's border is dark");
}

TEST_F(MaskCommand, DarkIsFoundWhereMostOfTheBorderIsObject)
{
  // A broad band across the picture: two thirds of the border are object.
  KnownPicture picture = Paint([](int, int) { return Rgb{ 12, 12, 14 }; }, Wooden);
  for (int y = 0; y < 120; ++y)
  {
    for (int x = 0; x < 160; ++x)
    {
      const bool inside = x > 26;
      picture.Truth(x, y) = inside ? 255 : 0;
      const Rgb colour = inside ? Wooden(x, y) : Rgb{ 12, 12, 14 };
      for (int channel = 0; channel < 3; ++channel)
      {
        picture.Color(x, y, channel) = static_cast<std::uint8_t>(colour[channel]);
      }
    }
  }
  EXPECT_GT(this->Made(picture, this->Options("dark")), 0.98);
}

TEST_F(MaskCommand, GrabCutFindsTheObjectBeforeATexturedBackground)
{
  const auto meadow = [](int x, int y)
  {
    const double wave = 40 * std::sin(0.9 * x) * std::cos(0.7 * y);
    return Rgb{ 70 + wave, 120 + wave, 170 - wave };
  };
  const KnownPicture picture = Paint(Wooden, meadow);
  const double central = this->Made(picture, this->Options("grabcut"));
  EXPECT_GT(central, HalfPixelIou);
  MaskOptions boxed = this->Options("grabcut");
  boxed.Box = { 38, 28, 126, 96 };
  EXPECT_GT(this->Made(picture, boxed), HalfPixelIou);
  // The same on every run, whatever was drawn before.
  cv::theRNG().state = 5;
  const auto first = MaskOf(this->In() / "a.png", boxed);
  cv::theRNG().state = 6;
  EXPECT_EQ(MaskOf(this->In() / "a.png", boxed).Values, first.Values);
}

TEST_F(MaskCommand, GrabCutNeedsAUsefulBox)
{
  this->Write("a.png", Paint(Wooden, UnevenGreen));
  MaskOptions options = this->Options("grabcut");
  options.Box = { 200, 10, 300, 100 };
  ExpectError([&] { this->Run(options); }, "a.png", "box", "must contain a part of the photograph");
  options.Box = { 0, 0, 160, 120 };
  ExpectError([&] { this->Run(options); }, "exclude one", "got 160x120 of 160x120");
}

TEST_F(MaskCommand, AlphaIsTakenAsItIsAndAutoPrefersIt)
{
  const KnownPicture picture = Paint(Wooden, Wooden); // nothing else tells it
  this->WriteWithAlpha("a.png", picture);
  for (const char* method : { "alpha", "auto" })
  {
    EXPECT_EQ(MaskOf(this->In() / "a.png", this->Options(method)).Values, picture.Truth.Values);
  }
  this->Write("b.png", Paint(Wooden, UnevenGreen));
  ExpectError([&] { this->Run(this->Options("alpha")); }, "b.png", "no alpha channel");
}

TEST_F(MaskCommand, AnEmptySilhouetteIsAnErrorAndNothingIsWritten)
{
  this->Write("a.png", Paint(Wooden, UnevenGreen));
  KnownPicture flat;
  this->Write("b.png", flat);
  ExpectError([&] { this->Run(this->Options("plain")); }, "b.png", "silhouette is empty");
  EXPECT_FALSE(fs::exists(this->Out() / "mask"));
}

TEST_F(MaskCommand, MasksLieWhereReadersLookForThem)
{
  const KnownPicture picture = Paint(Wooden, UnevenGreen);
  this->Write("a.png", picture);
  this->Write("b.jpg", picture);
  this->Run(this->Options("chroma"));
  EXPECT_TRUE(fs::exists(this->Out() / "mask/a.png"));
  EXPECT_TRUE(fs::exists(this->Out() / "mask/b.jpg.png"));
  EXPECT_EQ(MaskFileOf(this->Out(), "a.png"), this->Out() / "mask/a.png");
  EXPECT_EQ(MaskFileOf(this->Out(), "b.jpg"), this->Out() / "mask/b.jpg.png");
  // Two pictures side by side, each of its own size, with a margin and a label.
  const PictureSize sheet = ReadPictureSize(this->Out() / "contact-sheet.png");
  EXPECT_GT(sheet.Width, 320);
  EXPECT_GT(sheet.Height, 120);
}

TEST_F(MaskCommand, NothingIsEverOverwrittenSilently)
{
  const KnownPicture picture = Paint(Wooden, UnevenGreen);
  this->Write("a.png", picture);
  MaskOptions options = this->Options("chroma");
  options.InPlace = true;
  options.Out.clear();
  this->Run(options);
  const fs::path mask = this->In() / "mask/a.png";
  EXPECT_GT(IouOf(ReadGreyFile(mask), picture.Truth), HalfPixelIou);
  EXPECT_TRUE(fs::exists(this->In() / "mask/contact-sheet.png"));
  WriteImageFile(mask, Image<std::uint8_t>(160, 120, 1, 7).Ref());
  EXPECT_THROW(this->Run(options), UsageError);
  ExpectError([&] { this->Run(options); }, "mask/a.png", "there is a mask already", "--overwrite");
  EXPECT_EQ(ReadGreyFile(mask)(0, 0), 7);
  options.Overwrite = true;
  this->Run(options);
  EXPECT_EQ(ReadGreyFile(mask)(0, 0), 0);

  // One by another name is what readers take, so that is the one to be replaced.
  fs::rename(mask, this->In() / "a_mask.png");
  options.Overwrite = false;
  ExpectError([&] { this->Run(options); }, "a_mask.png", "there is a mask already");
  options.Overwrite = true;
  this->Run(options);
  EXPECT_FALSE(fs::exists(mask));
}

TEST_F(MaskCommand, AFolderWithoutPhotographsIsAnError)
{
  fs::create_directories(this->In());
  ExpectError(
    [&] { this->Run(this->Options("plain")); }, "contains neither a calibration nor a photograph");
}

TEST(MaskSheet, ShowsOutlinesAndDarkensTheRest)
{
  const KnownPicture picture = Paint(Wooden, [](int, int) { return Rgb{ 200, 200, 200 }; });
  const MaskThumbnail thumbnail = MakeMaskThumbnail("a", picture.Color.Ref(), picture.Truth.Ref());
  ASSERT_EQ(thumbnail.Picture.Width, 160);
  EXPECT_NEAR(thumbnail.Coverage, 0.145, 0.01);   // two discs of radius 26 and 15, less the overlap
  EXPECT_NEAR(thumbnail.Picture(5, 5, 0), 80, 6); // 200 * 0.4 and noise
  EXPECT_EQ(thumbnail.Picture(70, 60, 1), picture.Color(70, 60, 1)); // the object as it is
  int outline = 0;
  for (int x = 0; x < 160; ++x)
  {
    outline += thumbnail.Picture(x, 62, 0) == 255 && thumbnail.Picture(x, 62, 1) == 0;
  }
  EXPECT_GE(outline, 2) << "the row crosses the outline on both sides";
}
