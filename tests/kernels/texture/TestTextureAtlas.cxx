// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/TextureAtlas.h"

#include "support/Scene.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

using namespace novelview;
using namespace support;

namespace
{
/** A textured ball, eight photographs around it. */
struct Ball
{
  explicit Ball(int levels = 4)
    : Photos(TakeAll(Sphere(Vector3d::Zero(), 0.5), Waves(0.6), Ring(8, 45)))
    , Views(ViewsOf(Photos))
    , Mesh(SphereMesh(Vector3d::Zero(), 0.5, levels))
  {
  }
  std::vector<Photo> Photos;
  std::vector<View> Views;
  TriangleMesh Mesh;
};

/** Colour of the atlas at a point of a triangle. */
Vector3d ColourAt(const TextureAtlas& atlas, std::size_t cellId, const Vector3d& weights)
{
  Vector2d at = Vector2d::Zero();
  for (int corner = 0; corner < 3; ++corner)
  {
    at += weights[corner] * atlas.TexCoords[atlas.Mesh.Triangles[cellId][corner]];
  }
  Vector3d rgb;
  for (int channel = 0; channel < 3; ++channel)
  {
    rgb[channel] = SampleBilinear(atlas.Picture.Ref(), at.x() * atlas.Picture.Width - 0.5,
      at.y() * atlas.Picture.Height - 0.5, channel);
  }
  return rgb;
}
}

TEST(TextureAtlas, TrianglesKeepTheirPlacesAndOrder)
{
  const Ball ball;
  const TextureAtlas atlas = MakeTextureAtlas(ball.Mesh, ball.Views);
  ASSERT_EQ(atlas.Mesh.Triangles.size(), ball.Mesh.Triangles.size());
  ASSERT_EQ(atlas.PointOf.size(), atlas.Mesh.Points.size());
  ASSERT_EQ(atlas.TexCoords.size(), atlas.Mesh.Points.size());
  for (std::size_t cellId = 0; cellId < ball.Mesh.Triangles.size(); ++cellId)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const int ptId = atlas.Mesh.Triangles[cellId][corner];
      EXPECT_EQ(atlas.PointOf[ptId], ball.Mesh.Triangles[cellId][corner]);
      EXPECT_EQ(atlas.Mesh.Points[ptId], ball.Mesh.Points[atlas.PointOf[ptId]]);
    }
  }
  for (const Vector2d& at : atlas.TexCoords)
  {
    EXPECT_TRUE((at.array() > 0).all() && (at.array() < 1).all()) << at.transpose();
  }
}

TEST(TextureAtlas, ShowsTheSolidTextureWhereAPhotographSeesIt)
{
  const Ball ball;
  const Texture truth = Waves(0.6);
  const TextureAtlas atlas = MakeTextureAtlas(ball.Mesh, ball.Views);
  double sum = 0;
  int count = 0;
  for (std::size_t cellId = 0; cellId < atlas.Mesh.Triangles.size(); ++cellId)
  {
    Vector3d middle = Vector3d::Zero();
    for (int corner = 0; corner < 3; ++corner)
    {
      middle += atlas.Mesh.Points[atlas.Mesh.Triangles[cellId][corner]] / 3;
    }
    // Above 45 degrees the ring of cameras sees the ball at grazing angles or not at all.
    if (std::abs(middle.y()) < 0.35)
    {
      const Vector3d error =
        ColourAt(atlas, cellId, Vector3d::Constant(1.0 / 3)) - truth(0.5 * middle.normalized());
      sum += error.squaredNorm() / 3;
      ++count;
    }
  }
  // A wave of 0.6 units at 100 pixels a unit changes by up to 6 grey levels in a pixel; what is read
  // half a pixel off or blended with a slanting view is within that.
  EXPECT_LT(std::sqrt(sum / count), 4);
}

TEST(TextureAtlas, ChartsDoNotOverlap)
{
  const Ball ball;
  TextureAtlasOptions options;
  const TextureAtlas atlas = MakeTextureAtlas(ball.Mesh, ball.Views, options);
  EXPECT_GE(atlas.Charts, 8) << "each of eight photographs has a part nearest to it";
  // Texels whose centre is in a triangle: none may be in triangles that share no point.
  std::map<std::pair<int, int>, std::size_t> owner;
  for (std::size_t cellId = 0; cellId < atlas.Mesh.Triangles.size(); ++cellId)
  {
    Vector2d middle = Vector2d::Zero();
    for (int corner = 0; corner < 3; ++corner)
    {
      middle += atlas.TexCoords[atlas.Mesh.Triangles[cellId][corner]] / 3;
    }
    const std::pair<int, int> texel(static_cast<int>(middle.x() * atlas.Picture.Width),
      static_cast<int>(middle.y() * atlas.Picture.Height));
    const auto [at, fresh] = owner.try_emplace(texel, cellId);
    if (!fresh)
    {
      // At the boundary many triangles of one chart fall into a texel: near in space, then.
      const double apart = (atlas.Mesh.Points[atlas.Mesh.Triangles[cellId][0]] -
        atlas.Mesh.Points[atlas.Mesh.Triangles[at->second][0]])
                             .norm();
      EXPECT_LT(apart, 0.25) << texel.first << "," << texel.second;
    }
  }
}

TEST(TextureAtlas, PictureIsNoLargerThanAsked)
{
  const Ball ball;
  TextureAtlasOptions options;
  options.LargestSidePx = 128;
  const TextureAtlas atlas = MakeTextureAtlas(ball.Mesh, ball.Views, options);
  EXPECT_LE(std::max(atlas.Picture.Width, atlas.Picture.Height), 128);
  EXPECT_LT(atlas.Scale, 1);
  const TextureAtlas whole = MakeTextureAtlas(ball.Mesh, ball.Views);
  EXPECT_EQ(whole.Scale, 1) << "four thousand pixels are enough for a ball of a hundred";
}

TEST(TextureAtlas, PolesThatNoCameraSeesTakeColoursFromAround)
{
  const Ball ball;
  const Texture red = Plain(200, 40, 20);
  const std::vector<Photo> photos = TakeAll(Sphere(Vector3d::Zero(), 0.5), red, Ring(8, 45));
  const TextureAtlas atlas = MakeTextureAtlas(ball.Mesh, ViewsOf(photos));
  EXPECT_LT(atlas.SeenShare, 1) << "the poles cannot be seen";
  EXPECT_LT(atlas.UsedShare, 0.95) << "round charts leave corners, and each has padding";
  EXPECT_GT(atlas.UsedShare, 0.2);
  EXPECT_GT(atlas.SeenShare, 0.5) << "but most of the ball can";
  for (std::size_t cellId = 0; cellId < atlas.Mesh.Triangles.size(); ++cellId)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      // Rounding of the photographs, of the blend and of the fill: a level each.
      EXPECT_LT((ColourAt(atlas, cellId, Vector3d::Unit(corner)) - Vector3d(200, 40, 20)).norm(), 4)
        << "triangle " << cellId << " corner " << corner;
    }
  }
}

TEST(TextureAtlas, HiddenPartsTakeNoColourFromWhatHidesThem)
{
  // A small red ball before a large blue one: on the line between them no photograph may mix.
  const Shape large = Sphere(Vector3d(0, 0, -0.5), 0.6);
  const Shape small = Sphere(Vector3d(0, 0, 0.7), 0.25);
  const Texture halves = [](const Vector3d& p)
  { return p.z() > 0.3 ? Vector3d(200, 40, 20) : Vector3d(20, 40, 200); };
  const std::vector<Photo> photos = TakeAll(Union({ large, small }), halves, Ring(12, 30));
  TriangleMesh mesh = SphereMesh(Vector3d(0, 0, -0.5), 0.6, 4);
  const std::size_t cells = mesh.Triangles.size();
  const TriangleMesh front = SphereMesh(Vector3d(0, 0, 0.7), 0.25, 3);
  const Eigen::Vector3i shift = Eigen::Vector3i::Constant(static_cast<int>(mesh.Points.size()));
  mesh.Points.insert(mesh.Points.end(), front.Points.begin(), front.Points.end());
  for (const Eigen::Vector3i& t : front.Triangles)
  {
    mesh.Triangles.push_back(t + shift);
  }
  const TextureAtlas atlas = MakeTextureAtlas(mesh, ViewsOf(photos));
  int mixed = 0;
  for (std::size_t cellId = 0; cellId < cells; ++cellId)
  {
    mixed += ColourAt(atlas, cellId, Vector3d::Constant(1.0 / 3)).x() > 60;
  }
  // Along the boundary of the small ball's shadow an occlusion test to a pixel and a half may err.
  EXPECT_LT(mixed, 0.01 * static_cast<double>(cells));
}

TEST(TextureAtlas, NoTrianglesAreAnError)
{
  const Ball ball(1);
  try
  {
    MakeTextureAtlas({}, ball.Views);
    FAIL();
  }
  catch (const Error& error)
  {
    EXPECT_STREQ(error.what(), "texture atlas: the mesh has no triangles");
  }
}

TEST(TextureAtlas, AnotherSplitOfTheLoopsGivesTheSameBits)
{
  const Ball ball(3);
  Execution backwards;
  backwards.ParallelFor = [](std::int64_t count, const Execution::RangeBody& body)
  {
    for (std::int64_t i = count; i-- > 0;)
    {
      body(i, i + 1);
    }
  };
  const TextureAtlas one = MakeTextureAtlas(ball.Mesh, ball.Views);
  const TextureAtlas other = MakeTextureAtlas(ball.Mesh, ball.Views, {}, backwards);
  EXPECT_EQ(one.Picture.Values, other.Picture.Values);
  EXPECT_EQ(one.TexCoords, other.TexCoords);
}

TEST(TextureAtlas, LargeTrianglesShowTheTextureWhereRenderersLookForIt)
{
  // Two triangles that reach from near the camera far away.
  const Shape rectangle = Rectangle(0.5, 0.5);
  std::vector<Photo> photos =
    TakeAll(rectangle, Waves(0.8), { OnRing(50, 0, 1.5, SmallPictureK(130)) });
  const std::vector<View> views = ViewsOf(photos);
  TriangleMesh mesh;
  mesh.Points = { { -0.5, -0.5, 0 }, { 0.5, -0.5, 0 }, { 0.5, 0.5, 0 }, { -0.5, 0.5, 0 } };
  mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  const TextureAtlas atlas = MakeTextureAtlas(mesh, views);
  for (std::size_t cellId = 0; cellId < mesh.Triangles.size(); ++cellId)
  {
    for (const Vector3d& weights : { Vector3d(0.4, 0.3, 0.3), Vector3d(0.2, 0.6, 0.2) })
    {
      Vector3d point = Vector3d::Zero();
      for (int corner = 0; corner < 3; ++corner)
      {
        point += weights[corner] * mesh.Points[mesh.Triangles[cellId][corner]];
      }
      // With the photograph's perspective the colours came from a tenth of the side away.
      EXPECT_LT((ColourAt(atlas, cellId, weights) - Waves(0.8)(point)).norm(), 10);
    }
  }
}

TEST(TextureAtlas, SurfacesAtGrazingIncidenceHaveTheColoursOfTheirPhotographs)
{
  // The only camera looks at the rectangle from 75 degrees aside.
  std::vector<Photo> photos = TakeAll(Rectangle(0.5, 0.5), Waves(0.8), { OnRing(75) });
  TriangleMesh mesh;
  mesh.Points = { { -0.3, -0.3, 0 }, { 0.3, -0.3, 0 }, { 0.3, 0.3, 0 }, { -0.3, 0.3, 0 } };
  mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  const TextureAtlas atlas = MakeTextureAtlas(mesh, ViewsOf(photos));
  EXPECT_EQ(atlas.SeenShare, 1) << "none was seen when weights of cos^16 were too small to count";
}
