// SPDX-License-Identifier: GPL-3.0-or-later
#include "hull/VisualHull.h"
#include "silhouettes/SearchBox.h"
#include "support/Expect.h"
#include "support/SphereScene.h"
#include "support/TowerScene.h"

using namespace novelview;
using namespace support;

TEST(SearchBox, EnclosesTheObjectWhenAllCamerasStandOnOneSide)
{
  std::vector<Camera> cameras;
  for (const double angle : { -40.0, -20.0, 0.0, 20.0, 40.0 })
  {
    cameras.push_back(RoomyCamera(angle, angle / 2));
  }
  const auto photos = TakeAll(Sphere(Vector3d::Zero(), Radius), Plain(200, 200, 200), cameras);
  const Eigen::AlignedBox3d box = FindSearchBox(ViewsOf(photos));
  EXPECT_TRUE(box.contains(Vector3d::Constant(-Radius).eval()));
  EXPECT_TRUE(box.contains(Vector3d::Constant(Radius).eval()));
  // Across the viewing directions the box is tight; twice the sphere leaves room for perspective.
  EXPECT_LT(box.sizes().y(), 4 * Radius);
  EXPECT_NO_THROW(ComputeVisualHull(ViewsOf(photos)));
}

TEST(SearchBox, SilhouettesWithoutACommonPointNameTheOddOneOut)
{
  auto photos = SpherePhotos();
  photos[1].Cam.T.x() += 3; // looks past the object by three of its diameters
  ExpectError([&] { FindSearchBox(ViewsOf(photos)); },
    "view p1: its silhouette and those of the other views have no point in common");
}

TEST(SearchBox, APartBesideTheFrameIsNotCutOffByTheSideNextToIt)
{
  const auto photos = TowerPhotos();
  const auto views = ViewsOf(photos);
  const novelview::ImageRef<const std::uint8_t>& mask = views[0].Mask;
  ASSERT_FALSE(views[0].IsObject(40, 0));
  ASSERT_TRUE(views[0].IsObject(mask.Width - 1, mask.Height / 2));
  EXPECT_GT(FindSearchBox(views).max().y(), TowerTop);
  double top = 0;
  for (const Vector3d& sample : ComputeVisualHull(views).Samples.Points)
  {
    top = std::max(top, sample.y());
  }
  EXPECT_NEAR(top, TowerTop, 0.02); // two pixels
}

TEST(SearchBox, SilhouettesThatBoundNothingNameTheOptionThatDoes)
{
  auto photos = SpherePhotos();
  for (Photo& photo : photos)
  {
    SetMask(photo, Image<std::uint8_t>(160, 120, 1, 255));
  }
  ExpectError([&] { FindSearchBox(ViewsOf(photos)); },
    "do not bound the object on every side (the frames cut it); give a box that does with "
    "--hull-box");
}
