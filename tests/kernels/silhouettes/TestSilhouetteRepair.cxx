// SPDX-License-Identifier: GPL-3.0-or-later
#include "hull/VisualHull.h"
#include "silhouettes/SilhouetteRepair.h"
#include "support/Expect.h"
#include "support/TailScene.h"

using namespace novelview;
using namespace support;

namespace
{
MissingParts PartsOf(const std::vector<Photo>& photos, const Execution& execution = {})
{
  const std::vector<View> views = ViewsOf(photos);
  return FindMissingParts(views, ComputeVisualHull(views, {}).Surface, {}, execution);
}

/** Of the pixels that show the tail how many a part has, and how many pixels it has beside. */
std::pair<double, int> ShareAndExcess(const Image<std::uint8_t>& part, const Photo& photo)
{
  int tail = 0;
  int found = 0;
  int excess = 0;
  for (int y = 0; y < photo.Mask.Height; ++y)
  {
    for (int x = 0; x < photo.Mask.Width; ++x)
    {
      const bool isTail = ShowsTail(photo, x, y);
      const bool isPart = !part.Values.empty() && part(x, y) > 0;
      tail += isTail;
      found += isTail && isPart;
      excess += !isTail && isPart;
    }
  }
  return { static_cast<double>(found) / tail, excess };
}
}

TEST(SilhouetteRepair, APartThatTwoMasksLackComesBack)
{
  const std::vector<Photo> photos = PhotosOfTail({ 3, 4 });
  const MissingParts parts = PartsOf(photos);
  ASSERT_EQ(parts.size(), photos.size());
  for (const int viewId : { 3, 4 })
  {
    const auto [share, excess] = ShareAndExcess(parts[viewId], photos[viewId]);
    EXPECT_GT(share, 0.7) << viewId;
    EXPECT_LT(excess, 40) << viewId;
  }
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    EXPECT_TRUE(i == 3 || i == 4 || parts[i].Values.empty()) << i;
  }
}

TEST(SilhouetteRepair, WhereMasksAgreeNothingIsFound)
{
  for (const Image<std::uint8_t>& part : PartsOf(PhotosOfTail({})))
  {
    EXPECT_TRUE(part.Values.empty());
  }
}

TEST(SilhouetteRepair, WhatMostMasksLackStaysAway)
{
  for (const Image<std::uint8_t>& part : PartsOf(PhotosOfTail({ 0, 1, 2, 3, 4, 5, 6 })))
  {
    EXPECT_TRUE(part.Values.empty());
  }
}

TEST(SilhouetteRepair, MasksThatGrewOverTheBackgroundAreNoWitnesses)
{
  std::vector<Photo> photos = PhotosOfTail({ 3, 4 });
  for (Photo& photo : photos)
  {
    for (int y = 0; y < photo.Mask.Height; ++y)
    {
      for (int x = 0; x < photo.Mask.Width; ++x)
      {
        if (ShowsTail(photo, x, y))
        {
          std::fill_n(&photo.Color(x, y, 0), 3, std::uint8_t(4)); // as black as the background
        }
      }
    }
  }
  for (const Image<std::uint8_t>& part : PartsOf(photos))
  {
    EXPECT_TRUE(part.Values.empty());
  }
}

TEST(SilhouetteRepair, DoesNotDependOnThreads)
{
  const std::vector<Photo> photos = PhotosOfTail({ 3, 4 });
  const MissingParts one = PartsOf(photos);
  const MissingParts three = PartsOf(photos, InThreads(3));
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    EXPECT_EQ(one[i].Values, three[i].Values);
  }
}
