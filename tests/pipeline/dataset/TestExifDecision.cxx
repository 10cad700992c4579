// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/AtomicFile.h"
#include "dataset/Dataset.h"
#include "images/ExifOrientation.h"
#include "images/ImageFile.h"
#include "support/CheckScene.h"

using namespace novelview;
using namespace novelview::testing_support;
using testing::HasSubstr;

namespace
{
/** A JPEG file with an orientation tag. */
void WriteTagged(
  const std::filesystem::path& file, const Image<std::uint8_t>& pixels, int orientation)
{
  const std::vector<std::uint8_t> jpeg = EncodeJpeg(pixels.Ref(), 95, "test");
  std::string exif("Exif\0\0MM\0*\0\0\0\b\0\1\1\x12\0\3\0\0\0\1\0?\0\0\0\0\0\0", 32);
  exif[25] = static_cast<char>(orientation);
  const std::string length{ '\0', static_cast<char>(exif.size() + 2) };
  WriteTextAtomically(file,
    "\xff\xd8\xff\xe1" + length + exif +
      std::string(reinterpret_cast<const char*>(jpeg.data()) + 2, jpeg.size() - 2));
}

/** The pixels turned by 180 degrees, or by 90 degrees against the clock. */
Image<std::uint8_t> Turned(const Image<std::uint8_t>& from, bool half)
{
  Image<std::uint8_t> to(half ? from.Width : from.Height, half ? from.Height : from.Width, 3);
  for (int y = 0; y < from.Height; ++y)
  {
    for (int x = 0; x < from.Width; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        (half ? to(from.Width - 1 - x, from.Height - 1 - y, c) : to(y, from.Width - 1 - x, c)) =
          from(x, y, c);
      }
    }
  }
  return to;
}

/** The clean scene as COLMAP data set; its photographs are stored turned, with the tag. */
class ExifOrientation : public testing::Test
{
protected:
  ExifOrientation()
  {
    WriteDataset(this->Folder.Path, CleanPhotos(), { .Format = "colmap", .Masks = true });
  }
  void StoreTurned(bool half)
  {
    for (const support::Photo& photo : CleanPhotos())
    {
      // A PNG's name does no harm: OpenCV goes by the bytes.
      WriteTagged(this->Folder / ("images/" + photo.Name), Turned(photo.Color, half), half ? 3 : 6);
    }
  }
  void StoreUpright(int tag)
  {
    for (const support::Photo& photo : CleanPhotos())
    {
      WriteTagged(this->Folder / ("images/" + photo.Name), photo.Color, tag);
    }
  }
  DatasetIndex Read(const std::string& orientation = "auto") const
  {
    DatasetSource source;
    source.ExifOrientation = orientation;
    return ReadDatasetIndex(this->Folder.Path, source);
  }
  TemporaryFolder Folder;
};
}

TEST_F(ExifOrientation, TagOfAQuarterTurnIsAppliedWhereTheCalibrationIsOfTheTurnedSize)
{
  this->StoreTurned(false);
  const DatasetIndex index = this->Read();
  EXPECT_EQ(index.Cameras[0].Reading.Orientation, 6);
  ASSERT_EQ(index.Notes.size(), 1u);
  EXPECT_THAT(index.Notes[0].Text,
    HasSubstr("12 of 12 photographs have an EXIF orientation tag (6), which is applied"));
  const Dataset dataset = ReadDataset(index);
  EXPECT_EQ(dataset.Warnings, std::vector{ index.Notes[0].Text });
}

TEST_F(ExifOrientation, TagOfAHalfTurnIsAppliedWhereTheMasksFitTheTurnedPhotographs)
{
  this->StoreTurned(true);
  EXPECT_EQ(this->Read().Cameras[0].Reading.Orientation, 3);
  this->StoreUpright(3);
  EXPECT_EQ(this->Read().Cameras[0].Reading.Orientation, 1);
}

TEST_F(ExifOrientation, TagIsIgnoredWhereTheCalibrationIsOfTheStoredSize)
{
  this->StoreUpright(6);
  const DatasetIndex index = this->Read();
  EXPECT_EQ(index.Cameras[0].Reading.Orientation, 1);
  EXPECT_THAT(index.Notes[0].Text, HasSubstr("which is ignored: the calibration is for that size"));
  // Who is sure may say so; the error names the tag.
  ExpectError([&] { ReadDataset(this->Read("apply")); }, "another size than its calibration",
    "EXIF orientation tag (6) applied");
}
