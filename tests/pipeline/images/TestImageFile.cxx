// SPDX-License-Identifier: GPL-3.0-or-later
#include "ViewAccess.h"
#include "images/ImageFile.h"
#include "support/TestSupport.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <cmath>

using namespace novelview;
using namespace novelview::testing_support;

namespace
{
/** Neighbouring pixels differ, no symmetry anywhere. */
Image<std::uint8_t> Gradient(int width, int height, int channels)
{
  Image<std::uint8_t> image(width, height, channels);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      for (int c = 0; c < channels; ++c)
      {
        image(x, y, c) = static_cast<std::uint8_t>(7 * x + 31 * y + 90 * c);
      }
    }
  }
  return image;
}
}

TEST(ImageFile, LosslessFormatsReadBackTheSamePixels)
{
  const TemporaryFolder folder;
  const Image<std::uint8_t> color = Gradient(17, 9, 3);
  const Image<std::uint8_t> grey = Gradient(17, 9, 1);
  for (const char* name : { "a.png", "a.tif", "a.bmp", "a.ppm" })
  {
    WriteImageFile(folder / name, color.Ref());
    EXPECT_EQ(ReadColorFile(folder / name).Values, color.Values) << name;
    const PictureSize size = ReadPictureSize(folder / name);
    EXPECT_EQ(size.Width, 17) << name;
    EXPECT_EQ(size.Height, 9) << name;
  }
  WriteImageFile(folder / "grey.png", grey.Ref());
  EXPECT_EQ(ReadGreyFile(folder / "grey.png").Values, grey.Values);
}

TEST(ImageFile, SizeOfAJpegComesFromItsHeaderAlone)
{
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> jpeg = EncodeJpeg(Gradient(170, 90, 3).Ref(), 90, "test");
  std::string bytes(reinterpret_cast<const char*>(jpeg.data()), jpeg.size());
  // A segment of 1,000 bytes before the frame's, as of EXIF data; the picture itself is cut off.
  bytes.insert(2, std::string("\xff\xe1\x03\xea", 4) + std::string(1000, '\xff'));
  WriteText(folder / "cut.jpg", bytes.substr(0, bytes.size() / 2));
  const PictureSize size = ReadPictureSize(folder / "cut.jpg");
  EXPECT_EQ(size.Width, 170);
  EXPECT_EQ(size.Height, 90);
}

TEST(ImageFile, ReducedPixelsAreMeansOfTheirAreas)
{
  Image<std::uint8_t> image(4, 2);
  image.Values = { 10, 20, 200, 200, 30, 40, 100, 104 };
  EXPECT_EQ(ReducedImage(image.Ref(), 2, 1).Values, (std::vector<std::uint8_t>{ 25, 151 }));
  EXPECT_TRUE(ReducedImage({}, 2, 1).Values.empty());
}

TEST(ImageFile, ChannelsAreRedGreenBlue)
{
  const TemporaryFolder folder;
  // A PPM by hand: one red, one blue pixel.
  WriteText(
    folder / "rb.ppm", std::string("P6\n2 1\n255\n") + "\xff" + std::string(4, '\0') + "\xff");
  const Image<std::uint8_t> image = ReadColorFile(folder / "rb.ppm");
  EXPECT_EQ(image.Values, (std::vector<std::uint8_t>{ 255, 0, 0, 0, 0, 255 }));
}

TEST(ImageFile, FloatsKeepEveryBit)
{
  const TemporaryFolder folder;
  Image<float> depth(5, 4);
  for (std::size_t i = 0; i < depth.Values.size(); ++i)
  {
    depth.Values[i] = static_cast<float>(std::exp(3.0 * static_cast<double>(i)) / 7);
  }
  WriteFloatFile(folder / "depth.tif", depth.Ref());
  EXPECT_EQ(ReadFloatFile(folder / "depth.tif").Values, depth.Values);
}

TEST(ImageFile, TheTopRowOfThePictureIsVtksLast)
{
  const TemporaryFolder folder;
  WriteImageFile(folder / "a.png", Gradient(6, 4, 3).Ref());
  const vtkSmartPointer<vtkImageData> image = ReadColorImage(folder / "a.png");
  const auto rows = TopDownArray<const unsigned char>(image, arrays::Color, 3, "a", true);
  EXPECT_EQ(rows(2, 0, 1), 7 * 2 + 90);
  vtkDataArray* values = image->GetPointData()->GetArray(arrays::Color);
  EXPECT_EQ(values->GetComponent(3 * 6 + 2, 1), 7 * 2 + 90);
  WriteArray(folder / "b.png", image, arrays::Color);
  EXPECT_EQ(ReadColorFile(folder / "b.png").Values, Gradient(6, 4, 3).Values);
}

TEST(ImageFile, ErrorsNameTheFile)
{
  const TemporaryFolder folder;
  WriteText(folder / "text.png", "this is not a picture");
  ExpectError([&] { ReadColorFile(folder / "none.png"); }, "none.png", "no such file");
  ExpectError([&] { ReadColorFile(folder / "text.png"); }, "text.png", "cannot be read");
  const Image<std::uint8_t> image = Gradient(4, 4, 3);
  WriteImageFile(folder / "color.png", image.Ref());
  ExpectError([&] { ReadFloatFile(folder / "color.png"); }, "color.png", "is not a depth image");
  ExpectError([&] { WriteImageFile(folder / "a.xyz", image.Ref()); }, "a.xyz", "cannot be written");
  ExpectError([&] { WriteImageFile(folder / "text.png/a.png", image.Ref()); }, "text.png");
  ExpectError([&] { WriteFloatFile(folder / "a.png", Image<float>(2, 2).Ref()); }, "a.png", ".tif");
  // Nothing half-written stays behind.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.Path),
              std::filesystem::directory_iterator()),
    2);
}

TEST(ImageFile, ATruncatedPngIsAnErrorNotHalfAPicture)
{
  const TemporaryFolder folder;
  WriteImageFile(folder / "whole.png", Gradient(90, 90, 3).Ref());
  const std::string whole = ReadText(folder / "whole.png");
  WriteText(folder / "half.png", whole.substr(0, whole.size() / 2));
  testing::internal::CaptureStderr();
  ExpectError([&] { ReadColorFile(folder / "half.png"); }, "half.png", "cannot be read");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "the Error is all that is said";
}

TEST(ImageFile, ATruncatedJpegIsAnErrorNotHalfAPicture)
{
  const TemporaryFolder folder;
  WriteImageFile(folder / "whole.jpg", Gradient(90, 90, 3).Ref());
  EXPECT_EQ(ReadColorFile(folder / "whole.jpg").Width, 90);
  const std::string whole = ReadText(folder / "whole.jpg");
  WriteText(folder / "half.jpg", whole.substr(0, whole.size() - 100));
  testing::internal::CaptureStderr();
  ExpectError([&] { ReadColorFile(folder / "half.jpg"); }, "half.jpg", "cannot be read");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "the Error is all that is said";
}
