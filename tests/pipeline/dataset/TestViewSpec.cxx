// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/Error.h"
#include "dataset/ViewSpec.h"
#include "support/TestSupport.h"

using namespace novelview;
using namespace novelview::testing_support;

namespace
{
/** A camera that looks at the origin, which it sees in the middle of its frame. */
Photograph At(const std::string& name, double angleDeg, int width, int height, double focal)
{
  const double angle = angleDeg * EIGEN_PI / 180;
  Eigen::Matrix3d K;
  K << focal, 0, (width - 1) / 2.0, 0, focal, (height - 1) / 2.0, 0, 0, 1;
  Photograph photograph;
  photograph.Name = name;
  photograph.Cam = LookAt(4 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0),
    Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), K, width, height);
  return photograph;
}

Camera Between(const std::vector<Photograph>& photographs)
{
  DatasetIndex index;
  index.Cameras = photographs;
  return ResolveViewSpec(ParseViewSpec("between:0,1"), index).Cam;
}
}

TEST(ViewSpec, BetweenPhotographsOfDifferentSizesTheObjectKeepsItsPlaceAndSize)
{
  const Camera camera = Between({ At("a.png", 0, 640, 480, 700), At("b.png", 30, 320, 240, 350) });
  EXPECT_EQ(camera.Width, 640);
  EXPECT_EQ(camera.Height, 480);
  EXPECT_NEAR(camera.K(0, 0), 700, 1e-9);
  EXPECT_NEAR(camera.K(0, 2), 319.5, 1e-9);
  EXPECT_NEAR(camera.K(1, 2), 239.5, 1e-9);
}

TEST(ViewSpec, BetweenPortraitAndLandscapeTheObjectStaysInTheMiddle)
{
  const Camera camera = Between({ At("a.png", 0, 640, 480, 700), At("b.png", 30, 480, 640, 720) });
  EXPECT_NEAR(camera.K(0, 0), 710, 1e-9);
  EXPECT_NEAR(camera.K(0, 2), 319.5, 1e-9);
  EXPECT_NEAR(camera.K(1, 2), 239.5, 1e-9);
}

TEST(ViewSpec, PhotographsOfShapesThatCannotBeAveragedAreAnError)
{
  ExpectError(
    [] {
      Between({ At("a.png", 0, 640, 480, 700), At("b.png", 30, 640, 400, 700) });
    },
    "view b.png", "another shape than a.png, so their cameras cannot be averaged (got 640x400");
}
