// SPDX-License-Identifier: GPL-3.0-or-later
#include "images/MaskImage.h"
#include "support/TemporaryFolder.h"
#include "support/TestSupport.h"

#include <opencv2/imgcodecs.hpp>

using namespace novelview;
using namespace novelview::testing_support;

namespace
{
/** A mask of 4 x 2 pixels, the right half in one colour and the left in another. */
Image<std::uint8_t> Reread(int type, const cv::Scalar& left, const cv::Scalar& right)
{
  cv::Mat mat(2, 4, type, left);
  mat(cv::Rect(2, 0, 2, 2)).setTo(right);
  const TemporaryFolder folder;
  const std::string file = (folder / "mask.png").string();
  cv::imwrite(file, mat);
  return ReadMaskFile(file);
}

const std::vector<std::uint8_t> RightHalf{ 0, 0, 255, 255, 0, 0, 255, 255 };
}

TEST(MaskImage, MasksOfZeroAndOneAreNotEmpty)
{
  EXPECT_EQ(Reread(CV_8U, 0, 1).Values, RightHalf);
  EXPECT_EQ(Reread(CV_16U, 0, 1).Values, RightHalf);
}

TEST(MaskImage, ARedObjectOnBlackIsObject)
{
  EXPECT_EQ(Reread(CV_8UC3, { 0, 0, 0 }, { 0, 0, 255 }).Values, RightHalf);
}

TEST(MaskImage, WhiteWithAlphaIsWhatItsAlphaSays)
{
  EXPECT_EQ(Reread(CV_8UC4, { 255, 255, 255, 0 }, { 255, 255, 255, 255 }).Values, RightHalf);
}

TEST(MaskImage, SixteenBitsAreBroughtToEight)
{
  EXPECT_EQ(Reread(CV_16U, 0, 65535).Values, RightHalf);
  EXPECT_EQ(Reread(CV_16U, 0, 255).Values, RightHalf);
}

TEST(MaskImage, SoftMasksStayAsTheyAre)
{
  EXPECT_EQ(Reread(CV_8U, 100, 200).Values,
    (std::vector<std::uint8_t>{ 100, 100, 200, 200, 100, 100, 200, 200 }));
}

TEST(MaskImage, LabelsThatAreNoMaskAreNamedWithTheirLargestValue)
{
  ExpectError([] { Reread(CV_8U, 0, 38); }, "mask.png", "nothing in it is bright enough",
    "a largest value of 38", "expected 255 for the object, or masks of 0 and 1");
  ExpectError(
    [] {
      Reread(CV_8UC3, { 255, 0, 0 }, { 0, 0, 255 });
    },
    "mask.png", "nothing in it is dark enough", "black for the background");
}
