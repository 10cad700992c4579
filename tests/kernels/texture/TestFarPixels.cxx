// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/Expect.h"
#include "support/Scene.h"
#include "texture/FarPixels.h"
#include "texture/TextureMapping.h"

#include <cmath>
#include <utility>

using namespace novelview;
using namespace support;

namespace
{
constexpr int Width = 40;
constexpr int Height = 12;
constexpr int FirstFar = 20; ///< column

/** Stripes, half as bright from column FirstFar on; 4 columns of seam, where the truth is known. */
struct Halves
{
  Image<std::uint8_t> Far{ Width, Height };
  Image<std::uint8_t> Seam{ Width, Height };
  Image<float> Depth{ Width, Height, 1, 2.0f };
  Image<float> SeamColor{ Width, Height, 3 };
  Image<float> Color{ Width, Height, 3 };

  static float Stripe(int x) { return x % 6 < 3 ? 80.0f : 160.0f; }

  Halves()
  {
    for (int y = 0; y < Height; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        this->Far(x, y) = x >= FirstFar;
        this->Seam(x, y) = !this->Far(x, y) && x >= FirstFar - FarSeamPx;
        for (int channel = 0; channel < 3; ++channel)
        {
          this->Color(x, y, channel) = Stripe(x) * (this->Far(x, y) ? 0.5f : 1.0f);
          this->SeamColor(x, y, channel) = Stripe(x) * 0.5f;
        }
      }
    }
  }

  FarPixelInput Input() const
  {
    return { this->Far.Ref(), this->Depth.Ref(), 100, this->Seam.Ref(), this->SeamColor.Ref() };
  }
  void Level() { LevelFarPixels(this->Input(), this->Color); }
};
}

TEST(FarIslands, AreFarPixelsWithoutSeamInALargerUnseenRegion)
{
  Halves halves;
  Image<std::uint8_t> unseen(Width, Height);
  for (int y = 2; y < 10; ++y)
  {
    for (int x = 2; x < 12; ++x)
    {
      const bool island = y == 5 && x >= 4 && x < 8;
      unseen(x, y) = !island;
      halves.Far(x, y) = island;
    }
  }
  halves.Depth(7, 5) = 5; // another surface: an island of its own
  std::vector<PixelList> islands = FindFarIslands(halves.Input(), std::as_const(unseen).Ref());
  ASSERT_EQ(islands.size(), 2u);
  EXPECT_EQ(islands[0], (PixelList{ { 4, 5 }, { 5, 5 }, { 6, 5 } }));
  EXPECT_EQ(islands[1], (PixelList{ { 7, 5 } }));
  // The right half has a seam. An unseen region beside it must not change that.
  for (int y = 0; y < Height; ++y)
  {
    unseen(30, y) = 1;
    halves.Far(30, y) = 0;
  }
  for (int x = 31; x < Width; ++x)
  {
    halves.Far(x, 0) = 0; // what lies beyond is larger than the unseen column
  }
  EXPECT_EQ(FindFarIslands(halves.Input(), std::as_const(unseen).Ref()).size(), 2u);
}

TEST(FarPixels, TakeTheLevelOfTheSeamAndKeepTheirPattern)
{
  Halves halves;
  halves.Level();
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      // Levels added to both sums of a ratio leave five per cent, fading as much.
      EXPECT_NEAR(halves.Color(x, y, 1) / Halves::Stripe(x), 1, x < FirstFar ? 1e-6 : 0.1)
        << x << ", " << y;
    }
  }
}

TEST(FarPixels, ASurfaceBehindAJumpInDepthKeepsItsColours)
{
  Halves halves;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 30; x < Width; ++x)
    {
      halves.Depth(x, y) = 2.2f; // 0.2 units are 10 pixels
    }
  }
  halves.Level();
  EXPECT_NEAR(halves.Color(29, 5, 0), Halves::Stripe(29), 0.1 * Halves::Stripe(29));
  EXPECT_FLOAT_EQ(halves.Color(30, 5, 0), 0.5f * Halves::Stripe(30));
}

TEST(FarPixels, StepsInDepthAtTheThresholdDoNotBlowUp)
{
  Halves halves;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      // Steps of 3 pixels of the nearer depth, a little more or less.
      halves.Depth(x, y) = (x + y) % 2 ? 2.0f : 2.06f + 0.0001f * static_cast<float>(x * y % 9);
    }
  }
  const std::vector<float> before = halves.Color.Values;
  halves.Level();
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    EXPECT_GE(halves.Color.Values[i], before[i] * 0.99f);
    EXPECT_LE(halves.Color.Values[i], before[i] * 2.01f) << "the ratio along the seam is 2";
  }
}

TEST(FarPixels, WithoutASeamNothingChanges)
{
  Halves halves;
  halves.Seam = Image<std::uint8_t>(Width, Height);
  const std::vector<float> before = halves.Color.Values;
  halves.Level();
  EXPECT_EQ(halves.Color.Values, before);
}

TEST(FarPixels, APartThatOnlyALampLitPhotographFromAsideSeesIsNotAPatch)
{
  const Shape plane = Rectangle(0.6, 0.4);
  const std::vector<Camera> cameras = { OnRing(0), OnRing(10), OnRing(60) };
  auto photos = TakeAll(plane, Plain(100, 100, 100), { cameras[0], cameras[1] });
  const auto lit = TakeAll(plane, Plain(200, 200, 200), { cameras[2] });
  photos.push_back(lit[0]);
  for (int i = 0; i < 2; ++i) // the right half is outside the first two silhouettes
  {
    for (int y = 0; y < photos[i].ContourDistance.Height; ++y)
    {
      for (int x = 80; x < photos[i].ContourDistance.Width; ++x)
      {
        photos[i].ContourDistance(x, y) = static_cast<float>(79.5 - x);
      }
    }
  }
  TextureOptions options;
  options.References = 2;
  const TriangleMesh mesh = RectangleMesh(0.6, 0.4);
  const auto patch = TextureView(mesh, nullptr, ViewsOf(photos), OnRing(5), options);
  options.FarDeg = 20;
  const auto level = TextureView(mesh, nullptr, ViewsOf(photos), OnRing(5), options);
  EXPECT_NEAR(patch.Color(110, 60, 0), 200, 2);
  EXPECT_NEAR(level.Color(110, 60, 0), 100, 10);
  EXPECT_EQ(level.Color(50, 60, 0), patch.Color(50, 60, 0)) << "near pixels stay";
}
