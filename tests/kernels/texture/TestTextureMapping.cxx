// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/Expect.h"
#include "support/Scene.h"
#include "texture/TextureMapping.h"

using namespace novelview;
using namespace support;

namespace
{
Vector3d ColorAt(const TexturedView& picture, int x, int y)
{
  return { static_cast<double>(picture.Color(x, y, 0)), static_cast<double>(picture.Color(x, y, 1)),
    static_cast<double>(picture.Color(x, y, 2)) };
}

/** Largest difference to the texture at the true surface point, over seen pixels; and their count. */
double WorstError(const TexturedView& picture, const Shape& truth, const Texture& texture,
  const Camera& camera, int& compared, double withinPx = 1000)
{
  double worst = 0;
  compared = 0;
  for (int y = 0; y < camera.Height; ++y)
  {
    for (int x = 0; x < camera.Width; ++x)
    {
      const auto depth = DepthAt(truth, camera, Vector2d(x, y));
      const bool within = (Vector2d(x, y) - Vector2d(79.5, 59.5)).norm() < withinPx;
      if (picture.Seen(x, y) && depth && within)
      {
        ++compared;
        worst = std::max(worst,
          (ColorAt(picture, x, y) - texture(camera.Unproject(Vector2d(x, y), *depth)))
            .cwiseAbs()
            .maxCoeff());
      }
    }
  }
  return worst;
}

// Waves of 40 pixels and amplitudes 60 and 36 bend by at most 1.5 and (0.7^2 of it) 0.4 grey levels
// per squared pixel and axis; bilinear interpolation is off by an eighth of that per axis. A slanted
// photograph has shorter waves, and twice half a level is lost to rounding.
constexpr double InterpolationLevels = 2.0;
constexpr double LongWaves = 0.4;

/** A plate from column 28.9 to 129.7. Sub-columns stand at -0.4, -0.2, 0, 0.2, 0.4 of a pixel. */
TexturedView RimPlate(bool softBoundary = false)
{
  TriangleMesh mesh = RectangleMesh(1, 0.3);
  for (Vector3d& point : mesh.Points)
  {
    point.x() = ((point.x() < 0 ? 28.9 : 129.7) - 79.5) / 100;
  }
  const auto photos = TakeAll(Rectangle(2, 2), Plain(200, 200, 200), { OnRing(0), OnRing(20) });
  TextureOptions options;
  options.BoundarySamples = 5;
  options.SoftBoundary = softBoundary;
  return TextureView(mesh, nullptr, ViewsOf(photos), OnRing(0), options);
}
}

TEST(TextureMapping, APlaneFromKnownPhotographsIsExactToInterpolation)
{
  const Shape plane = Rectangle(0.6, 0.4);
  const auto photos = TakeAll(plane, Waves(LongWaves), { OnRing(-20), OnRing(0), OnRing(25, 10) });
  const Camera novel = OnRing(11, 4);
  const auto picture = TextureView(RectangleMesh(0.6, 0.4), nullptr, ViewsOf(photos), novel);
  int compared = 0;
  EXPECT_LT(WorstError(picture, plane, Waves(LongWaves), novel, compared), InterpolationLevels);
  EXPECT_GT(compared, 8000); // of 120 x 80
  for (int y = 0; y < novel.Height; ++y)
  {
    for (int x = 0; x < novel.Width; ++x)
    {
      const bool hit = picture.Mask(x, y) == 255;
      EXPECT_EQ(picture.CellId(x, y) >= 0, hit);
      EXPECT_EQ(picture.Depth(x, y) > 0, hit);
      if (hit)
      {
        EXPECT_NEAR(picture.Depth(x, y), *DepthAt(plane, novel, Vector2d(x, y)), 1e-5);
      }
      else
      {
        EXPECT_EQ(ColorAt(picture, x, y), Vector3d::Zero());
        EXPECT_EQ(picture.Seen(x, y), 0);
      }
    }
  }
}

TEST(TextureMapping, ASphereFromKnownPhotographsIsExactToInterpolation)
{
  const Shape sphere = Sphere(Vector3d::Zero(), 0.5);
  const auto photos = TakeAll(sphere, Waves(LongWaves), Ring(12, 30));
  const Camera novel = OnRing(15);
  TextureOptions options;
  options.References = 2; // 15 degrees to either side
  const auto picture =
    TextureView(SphereMesh(Vector3d::Zero(), 0.5, 5), nullptr, ViewsOf(photos), novel, options);
  int compared = 0;
  // Within half the radius the normal turns by 30 degrees, 45 to a photograph: there waves are
  // sqrt(2) shorter and bend twice as much as on the plane.
  EXPECT_LT(
    WorstError(picture, sphere, Waves(LongWaves), novel, compared, 25), 2 * InterpolationLevels);
  EXPECT_GT(compared, 1900); // of pi 25^2 = 1963
  EXPECT_GT(std::count(picture.Seen.Values.begin(), picture.Seen.Values.end(), 1), 7600)
    << "of pi 50^2 = 7854 all but the very rim are seen";
}

TEST(TextureMapping, APhotographFromTheNovelCameraItselfIsReproduced)
{
  const Shape plane = Rectangle(0.6, 0.4);
  const auto photos = TakeAll(plane, Waves(0.1), { OnRing(0), OnRing(30), OnRing(-30) });
  TextureOptions options;
  options.References = 1;
  const auto picture =
    TextureView(RectangleMesh(0.6, 0.4), nullptr, ViewsOf(photos), OnRing(0), options);
  int compared = 0;
  for (int y = 0; y < 120; ++y)
  {
    for (int x = 0; x < 160; ++x)
    {
      // Nearer to its silhouette's border than BorderPx the photograph leaves it to others.
      const bool inside = photos[0].ContourDistance(x, y) > 1.6;
      for (int channel = 0; channel < 3 && inside; ++channel)
      {
        ++compared;
        EXPECT_NEAR(picture.Color(x, y, channel), photos[0].Color(x, y, channel), 1);
      }
    }
  }
  EXPECT_GT(compared, 20000);
}

TEST(TextureMapping, WeightsAreThePowerOfTheCosineBetweenRays)
{
  // Two plain photographs, 100 and 200 grey: the blend shows the weights.
  std::vector<Photo> photos;
  photos.push_back(Take(Rectangle(0.6, 0.4), Plain(100, 100, 100), OnRing(-30), "a"));
  photos.push_back(Take(Rectangle(0.6, 0.4), Plain(200, 200, 200), OnRing(10), "b"));
  TextureOptions options;
  options.Power = 5;
  const Camera novel = OnRing(0);
  const auto picture =
    TextureView(RectangleMesh(0.6, 0.4), nullptr, ViewsOf(photos), novel, options);
  const Vector3d point = novel.Unproject(Vector2d(100, 50), 4);
  const auto cosine = [&](const Camera& camera)
  { return (point - novel.Centre()).normalized().dot((point - camera.Centre()).normalized()); };
  const double a = std::pow(cosine(photos[0].Cam), 5);
  const double b = std::pow(cosine(photos[1].Cam), 5);
  EXPECT_NEAR(picture.Color(100, 50, 0), (100 * a + 200 * b) / (a + b), 0.51); // rounding
}

namespace
{
/** A blue wall, and a red plate before it that hides part of it from the camera on the left. */
struct PlateCase
{
  TriangleMesh Wall = RectangleMesh(0.7, 0.5, 0, 4);
  TriangleMesh Plate = RectangleMesh(0.15, 0.15, 0.5);
  Shape Both = Union({ Rectangle(0.7, 0.5), Rectangle(0.15, 0.15, 0.5) });
  Texture Colors = [](const Vector3d& p) -> Vector3d
  { return p.z() > 0.25 ? Vector3d(255, 0, 0) : Vector3d(0, 0, 255); };
  std::vector<Photo> Photos = TakeAll(Both, Colors, { OnRing(-30), OnRing(30) });
  std::vector<View> Views = ViewsOf(Photos);
  Camera Novel = OnRing(-10);
  /** A pixel that shows wall hidden by the plate from the left camera but not from the right. */
  Vector2d Hidden() const
  {
    const Vector3d onPlate(0.05, 0, 0.5);
    const Vector3d left = this->Photos[0].Cam.Centre();
    const Vector3d onWall = left + (onPlate - left) * (left.z() / (left.z() - 0.5));
    return this->Novel.Project(onWall);
  }
};
}

TEST(TextureMapping, APhotographWhoseViewIsBlockedIsLeftOut)
{
  const PlateCase plate;
  TriangleMesh scene = plate.Wall;
  const Eigen::Vector3i shift = Eigen::Vector3i::Constant(static_cast<int>(scene.Points.size()));
  scene.Points.insert(scene.Points.end(), plate.Plate.Points.begin(), plate.Plate.Points.end());
  for (const Eigen::Vector3i& t : plate.Plate.Triangles)
  {
    scene.Triangles.push_back(t + shift);
  }
  const auto picture = TextureView(scene, nullptr, plate.Views, plate.Novel);
  const int x = static_cast<int>(std::lround(plate.Hidden().x()));
  const int y = static_cast<int>(std::lround(plate.Hidden().y()));
  ASSERT_LT(picture.CellId(x, y), 32) << "the wall, not the plate";
  EXPECT_EQ(ColorAt(picture, x, y), Vector3d(0, 0, 255));
}

TEST(TextureMapping, OccludersBlockWithoutBeingShown)
{
  const PlateCase plate;
  const int x = static_cast<int>(std::lround(plate.Hidden().x()));
  const int y = static_cast<int>(std::lround(plate.Hidden().y()));
  const auto without = TextureView(plate.Wall, nullptr, plate.Views, plate.Novel);
  EXPECT_GT(without.Color(x, y, 0), 100) << "red bleeds in when nobody knows of the plate";
  const auto with = TextureView(plate.Wall, &plate.Plate, plate.Views, plate.Novel);
  EXPECT_EQ(ColorAt(with, x, y), Vector3d(0, 0, 255));
  EXPECT_EQ(with.CellId.Values, without.CellId.Values);
}

TEST(TextureMapping, DepthMapsOfThePhotographsBlockWhenAsked)
{
  PlateCase plate;
  for (std::size_t i = 0; i < plate.Views.size(); ++i)
  {
    plate.Views[i].DepthMap = std::as_const(plate.Photos[i].TrueDepth).Ref();
  }
  const int x = static_cast<int>(std::lround(plate.Hidden().x()));
  const int y = static_cast<int>(std::lround(plate.Hidden().y()));
  TextureOptions options;
  options.UseDepthMaps = true;
  EXPECT_EQ(ColorAt(TextureView(plate.Wall, nullptr, plate.Views, plate.Novel, options), x, y),
    Vector3d(0, 0, 255));
  options.OcclusionPx = 2; // half a unit behind is fifty footprints: exp(-625)
  EXPECT_EQ(ColorAt(TextureView(plate.Wall, nullptr, plate.Views, plate.Novel, options), x, y),
    Vector3d(0, 0, 255));
}

TEST(TextureMapping, WhatNoPhotographSeesIsFlaggedAndFilledFromAround)
{
  const PlateCase plate;
  const std::vector<View> leftOnly(plate.Views.begin(), plate.Views.begin() + 1);
  const auto picture = TextureView(plate.Wall, &plate.Plate, leftOnly, plate.Novel);
  const int x = static_cast<int>(std::lround(plate.Hidden().x()));
  const int y = static_cast<int>(std::lround(plate.Hidden().y()));
  EXPECT_EQ(picture.Seen(x, y), 0);
  EXPECT_EQ(picture.Mask(x, y), 255);
  int black = 0;
  for (int j = 0; j < 120; ++j)
  {
    for (int i = 0; i < 160; ++i)
    {
      black += picture.Mask(i, j) && ColorAt(picture, i, j).isZero();
    }
  }
  EXPECT_EQ(black, 0);
}

TEST(TextureMapping, NoBackgroundBleedsInAtTheRim)
{
  const auto photos = TakeAll(Sphere(Vector3d::Zero(), 0.5), Plain(200, 200, 200), Ring(12, 30));
  const auto picture =
    TextureView(SphereMesh(Vector3d::Zero(), 0.505, 4), nullptr, ViewsOf(photos), OnRing(15));
  for (int y = 0; y < 120; ++y)
  {
    for (int x = 0; x < 160; ++x)
    {
      // The background is black; a filled or blended pixel may not be darker than the object.
      EXPECT_EQ(picture.Color(x, y, 1), picture.Mask(x, y) ? 200 : 0) << x << " " << y;
    }
  }
}

TEST(TextureMapping, RimPixelsAreWeighedByTheirCoverage)
{
  const auto picture = RimPlate();
  EXPECT_EQ(picture.Mask(28, 60), 0);
  EXPECT_EQ(picture.Mask(29, 60), 255);
  EXPECT_EQ(picture.Color(29, 60, 0), 120); // 28.6 and 28.8 miss the plate: three fifths of 200
  EXPECT_EQ(picture.Mask(130, 60), 0);      // one of five is less than half
  EXPECT_EQ(picture.Color(100, 60, 0), 200);
}

TEST(TextureMapping, ASoftBoundaryKeepsWhatIsCoveredByLessThanHalf)
{
  // The plate's right edge covers one of five sub-columns of column 130.
  const auto hard = RimPlate();
  const auto soft = RimPlate(true);
  EXPECT_EQ(hard.Color(130, 60, 0), 0);
  EXPECT_EQ(soft.Color(130, 60, 0), 40); // one fifth of 200
  EXPECT_EQ(soft.Mask.Values, hard.Mask.Values);
  EXPECT_EQ(soft.Depth.Values, hard.Depth.Values);
  EXPECT_EQ(soft.CellId.Values, hard.CellId.Values);
  EXPECT_EQ(soft.Seen.Values, hard.Seen.Values);
  for (std::size_t i = 0; i < hard.Mask.Values.size(); ++i)
  {
    if (hard.Mask.Values[i])
    {
      ASSERT_EQ(soft.Color.Values[3 * i], hard.Color.Values[3 * i]) << i;
    }
  }
}

TEST(TextureMapping, SameBitsWithOneAndMoreThreads)
{
  const PlateCase plate;
  TextureOptions options;
  options.BoundarySamples = 3;
  const auto one = TextureView(plate.Wall, &plate.Plate, plate.Views, plate.Novel, options);
  const auto three =
    TextureView(plate.Wall, &plate.Plate, plate.Views, plate.Novel, options, InThreads(3));
  EXPECT_EQ(one.Color.Values, three.Color.Values);
  EXPECT_EQ(one.Seen.Values, three.Seen.Values);
}

TEST(TextureMapping, AnEmptyMeshIsABlackPicture)
{
  const PlateCase plate;
  const auto picture = TextureView({}, nullptr, plate.Views, plate.Novel);
  EXPECT_THAT(picture.Mask.Values, testing::Each(0));
  EXPECT_THAT(picture.Color.Values, testing::Each(0));
}
