// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ConnectedRegions_h
#define novelview_ConnectedRegions_h

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace novelview
{
/** Pixels (x, y). */
using PixelRegion = std::vector<std::pair<int, int>>;

/**
 * Calls body(region) for every region of pixels for which isMember(x, y) is true and that are connected
 * by their sides (4 neighbours), in the order of their first pixels in rows. The body may make the
 * region's pixels no members any more.
 */
template <class IsMember, class Body>
void ForEachRegion(int width, int height, const IsMember& isMember, const Body& body)
{
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(width) * height, 0);
  PixelRegion region;
  const auto add = [&](int x, int y)
  {
    const bool inside = x >= 0 && y >= 0 && x < width && y < height;
    if (inside && !seen[static_cast<std::size_t>(y) * width + x] && isMember(x, y))
    {
      seen[static_cast<std::size_t>(y) * width + x] = 1;
      region.emplace_back(x, y);
    }
  };
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      region.clear();
      add(x, y);
      for (std::size_t n = 0; n < region.size(); ++n)
      {
        const auto [i, j] = region[n];
        add(i - 1, j);
        add(i + 1, j);
        add(i, j - 1);
        add(i, j + 1);
      }
      if (!region.empty())
      {
        body(static_cast<const PixelRegion&>(region));
      }
    }
  }
}
}

#endif
