// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ConnectedRegions.h"

#include <gtest/gtest.h>

#include <string>

using namespace novelview;

namespace
{
/** The sizes of the regions of the character in a picture of text. */
std::vector<std::size_t> Sizes(const std::vector<std::string>& rows, char of)
{
  std::vector<std::size_t> sizes;
  ForEachRegion(
    static_cast<int>(rows[0].size()), static_cast<int>(rows.size()),
    [&](int x, int y) { return rows[y][x] == of; },
    [&](const PixelRegion& region) { sizes.push_back(region.size()); });
  return sizes;
}
}

TEST(ConnectedRegions, AreConnectedBySidesInTheOrderOfTheirFirstPixels)
{
  const std::vector<std::string> rows = { "#..#", ".#.#", "##..", "...#" };
  EXPECT_EQ(Sizes(rows, '#'), (std::vector<std::size_t>{ 1, 2, 3, 1 }));
  EXPECT_EQ(Sizes(rows, '.'), (std::vector<std::size_t>{ 8, 1 }));
  EXPECT_TRUE(Sizes(rows, 'x').empty());
}

TEST(ConnectedRegions, TheBodyMayTakePixelsOutOfThem)
{
  std::vector<std::string> rows = { "##.", "..#" };
  int regions = 0;
  ForEachRegion(
    3, 2, [&](int x, int y) { return rows[y][x] == '#'; },
    [&](const PixelRegion& region)
    {
      ++regions;
      for (const auto& [x, y] : region)
      {
        rows[y][x] = '.';
      }
    });
  EXPECT_EQ(regions, 2);
  EXPECT_EQ(rows, (std::vector<std::string>{ "...", "..." }));
}
