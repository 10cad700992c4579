// SPDX-License-Identifier: GPL-3.0-or-later
#include "images/ImageFile.h"
#include "images/Metrics.h"
#include "support/TestSupport.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <sstream>

using namespace novelview;
using namespace novelview::testing_support;

namespace
{
/** A picture with its mask. */
struct Picture
{
  Image<std::uint8_t> Color;
  Image<std::uint8_t> Mask;

  MaskedPicture Masked() const { return { this->Color.Ref(), this->Mask.Ref() }; }
};

/** A disc with waves and noise on it; something is outside of the mask, too. */
Picture Disc(double centreX, double phase, unsigned int seed)
{
  Picture picture{ Image<std::uint8_t>(90, 70, 3, 30), Image<std::uint8_t>(90, 70) };
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-20, 20);
  for (int y = 0; y < 70; ++y)
  {
    for (int x = 0; x < 90; ++x)
    {
      picture.Mask(x, y) = std::hypot(x - centreX, y - 33) < 28 ? 255 : 0;
      for (int c = 0; c < 3; ++c)
      {
        picture.Color(x, y, c) = static_cast<std::uint8_t>(
          120 + 60 * std::sin(0.3 * x + 0.2 * y * (c + 1) + phase) + noise(random));
      }
    }
  }
  return picture;
}

/** Even grey, object in the rectangle [x0, x1) x [20, 40). */
Picture Box(int x0, int x1, std::uint8_t grey)
{
  Picture picture{ Image<std::uint8_t>(60, 60, 3, grey), Image<std::uint8_t>(60, 60) };
  for (int y = 20; y < 40; ++y)
  {
    for (int x = x0; x < x1; ++x)
    {
      picture.Mask(x, y) = 255;
    }
  }
  return picture;
}

std::string OutputOf(const std::string& command)
{
  std::string output;
  FILE* pipe = ::popen(command.c_str(), "r");
  char part[256];
  while (pipe && std::fgets(part, sizeof(part), pipe))
  {
    output += part;
  }
  return pipe && ::pclose(pipe) == 0 ? output : "";
}
}

TEST(Metrics, OfEqualPicturesAreTheBest)
{
  const Picture picture = Disc(40, 0, 1);
  const Scores scores = Compare(picture.Masked(), picture.Masked());
  EXPECT_EQ(scores.Rms, 0);
  EXPECT_NEAR(scores.Ssim, 1, 1e-12); // rounding of the divisions
  EXPECT_EQ(scores.Iou, 1);
  EXPECT_EQ(scores.Missing, 0);
  EXPECT_EQ(scores.Excess, 0);
}

TEST(Metrics, AreTheHandComputedOnes)
{
  // Truth: columns 10-29 grey 100. Rendered: columns 15-39 grey 110. Twenty rows each.
  const Picture truth = Box(10, 30, 100);
  const Picture rendered = Box(15, 40, 110);
  const Scores scores = Compare(rendered.Masked(), truth.Masked());
  EXPECT_DOUBLE_EQ(scores.Iou, 15.0 / 30);
  EXPECT_DOUBLE_EQ(scores.Missing, 5.0 / 20);
  EXPECT_DOUBLE_EQ(scores.Excess, 10.0 / 20);
  // 5 columns of 100 against black, 15 of 110 against 100, 10 of 110 against black.
  const double rms = std::sqrt((5 * 100.0 * 100 + 15 * 10.0 * 10 + 10 * 110.0 * 110) / 30);
  EXPECT_NEAR(scores.Rms, rms, 1e-9);
  EXPECT_NEAR(scores.Psnr, 20 * std::log10(255 / rms), 1e-9);
  const Image<float> error = ErrorMap(rendered.Masked(), truth.Masked());
  EXPECT_FLOAT_EQ(error(12, 30), 100);
  EXPECT_FLOAT_EQ(error(20, 30), 10);
  EXPECT_FLOAT_EQ(error(35, 30), 110);
  EXPECT_EQ(error(5, 30), 0);
  EXPECT_EQ(error(20, 10), 0);
}

TEST(Metrics, AgreeWithTheIndependentYardstick)
{
  const std::filesystem::path script = SharedFolder() / "yardstick" / "evaluate.py";
  if (!std::filesystem::exists(script) ||
    OutputOf("/usr/bin/python3 -c 'import cv2, skimage; print(1)' 2>/dev/null").empty())
  {
    GTEST_SKIP() << "needs " << script << " and python3 with OpenCV and scikit-image";
  }
  const TemporaryFolder folder;
  const Picture truth = Disc(40, 0, 1);
  const Picture rendered = Disc(45, 0.4, 2);
  WriteImageFile(folder / "truth.png", truth.Color.Ref());
  WriteImageFile(folder / "truthmask.png", truth.Mask.Ref());
  WriteImageFile(folder / "render.png", rendered.Color.Ref());
  WriteImageFile(folder / "rendermask.png", rendered.Mask.Ref());
  std::string command = "/usr/bin/python3 '" + script.string() + "'";
  for (const char* name : { "render.png", "truth.png", "truthmask.png", "rendermask.png" })
  {
    command += " '" + (folder / name).string() + "'";
  }
  std::istringstream output(OutputOf(command));
  std::map<std::string, double> yardstick;
  std::string key;
  for (double value; output >> key >> value;)
  {
    yardstick[key] = value;
  }
  ASSERT_EQ(yardstick.size(), 4u);
  const Scores scores = Compare(rendered.Masked(), truth.Masked());
  // The same formulas: what differs is that the script prints four decimals.
  EXPECT_NEAR(scores.Rms, yardstick["rms"], 1e-4);
  EXPECT_NEAR(scores.Psnr, yardstick["psnr"], 1e-4);
  EXPECT_NEAR(scores.Ssim, yardstick["ssim"], 1e-4);
  EXPECT_NEAR(scores.Iou, yardstick["iou"], 1e-4);
}

TEST(Metrics, RefuseWhatCannotBeCompared)
{
  const Picture good = Box(10, 30, 100);
  Picture other = good;
  other.Color = Image<std::uint8_t>(60, 50, 3);
  ExpectError([&] { Compare(other.Masked(), good.Masked()); }, "rendered picture", "got 60x50",
    "expected 60x60");
  const Picture empty = Box(10, 10, 100);
  ExpectError(
    [&] { Compare(good.Masked(), empty.Masked()); }, "mask of the true picture", "is empty");
  const Picture small{ Image<std::uint8_t>(10, 30, 3), Image<std::uint8_t>(10, 30, 1, 255) };
  ExpectError([&] { Compare(small.Masked(), small.Masked()); }, "got 10x30", "at least 11x11");
}
