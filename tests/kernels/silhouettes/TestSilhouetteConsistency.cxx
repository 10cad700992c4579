// SPDX-License-Identifier: GPL-3.0-or-later
#include "silhouettes/SilhouetteConsistency.h"
#include "support/Expect.h"
#include "support/Scene.h"

#include <cmath>

using namespace novelview;
using namespace support;

namespace
{
/** Turns a camera about its own centre so that the picture moves by about this many pixels. */
void Turn(Photo& photo, double pixelsX, double pixelsY)
{
  const double focal = photo.Cam.K(0, 0);
  const Vector3d centre = photo.Cam.Centre();
  photo.Cam.R = Eigen::AngleAxisd(pixelsX / focal, Vector3d::UnitY()).toRotationMatrix() *
    Eigen::AngleAxisd(pixelsY / focal, Vector3d::UnitX()).toRotationMatrix() * photo.Cam.R;
  photo.Cam.T = -photo.Cam.R * centre;
}
}

TEST(SilhouetteConsistency, ASetThatAgreesIsLeftAlone)
{
  const std::vector<Photo> photos = BoxPhotos();
  for (const double offset : FindContourOffsets(ViewsOf(photos)))
  {
    EXPECT_EQ(offset, 0);
  }
}

TEST(SilhouetteConsistency, TheOneThatIsTooSmallIsFoundWithItsOffset)
{
  for (const float shrunk : { 1.f, 2.f, 3.f })
  {
    std::vector<Photo> photos = BoxPhotos();
    ShrinkSilhouette(photos[3], shrunk);
    const auto offsets = FindContourOffsets(ViewsOf(photos));
    for (std::size_t i = 0; i < offsets.size(); ++i)
    {
      // The contours of these photographs lie where they should to a tenth of a pixel; perspective
      // makes a pixel of one view up to a quarter more or less of another's.
      EXPECT_NEAR(offsets[i], i == 3 ? shrunk : 0, 0.35 * shrunk) << i;
      EXPECT_TRUE(i == 3 || offsets[i] == 0) << i;
    }
  }
}

TEST(SilhouetteConsistency, ManyPhotographsFindItWithFewerRaysOfEach)
{
  std::vector<Photo> photos = BoxPhotos();
  ShrinkSilhouette(photos[3], 2);
  ConsistencyOptions options;
  options.RaysOfAll = 37 * static_cast<int>(photos.size()); // as many as of each of 192
  const auto offsets = FindContourOffsets(ViewsOf(photos), options);
  EXPECT_NE(offsets, FindContourOffsets(ViewsOf(photos))) << "other rays, other numbers";
  for (std::size_t i = 0; i < offsets.size(); ++i)
  {
    EXPECT_NEAR(offsets[i], i == 3 ? 2 : 0, 0.7) << i; // as in the test above
    EXPECT_TRUE(i == 3 || offsets[i] == 0) << i;
  }
}

TEST(SilhouetteConsistency, TheOneThatIsTooLargeHarmsNobody)
{
  std::vector<Photo> photos = BoxPhotos();
  ShrinkSilhouette(photos[3], -2);
  for (const double offset : FindContourOffsets(ViewsOf(photos)))
  {
    EXPECT_EQ(offset, 0);
  }
}

TEST(SilhouetteConsistency, CamerasThatAreOffGiveEveryoneSlack)
{
  std::vector<Photo> photos = BoxPhotos();
  std::mt19937 random(3);
  std::normal_distribution<double> pixels(0, 1);
  for (Photo& photo : photos)
  {
    const double x = pixels(random);
    const double y = pixels(random);
    Turn(photo, x, y);
  }
  ConsistencyOptions options;
  options.Outstanding = 1e9; // the common slack alone
  const auto offsets = FindContourOffsets(ViewsOf(photos), options);
  for (const double offset : offsets)
  {
    EXPECT_EQ(offset, offsets[0]);
  }
  EXPECT_GT(offsets[0], 0.25);
  EXPECT_LE(offsets[0], options.MaxSlackPx);
}

TEST(SilhouetteConsistency, SilhouettesThatBoundNoBoxAreLeftToOthersToReport)
{
  std::vector<Photo> photos = BoxPhotos();
  std::fill(photos[0].Mask.Values.begin(), photos[0].Mask.Values.end(), 0);
  const auto offsets = FindContourOffsets(ViewsOf(photos));
  EXPECT_EQ(offsets, std::vector<double>(photos.size(), 0));
}
