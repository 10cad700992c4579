// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_FillHolesIteratively_h
#define novelview_FillHolesIteratively_h

#include <utility>
#include <vector>

namespace novelview
{
/**
 * Fills what is open from what is known, a layer at a time. fill(item) gives an open item a value by
 * its known neighbours and returns whether there are any; know(item) makes it known, once the layer
 * is done. What no layer reaches is left as it is. The order of `open` does not matter.
 */
template <class Item, class Fill, class Know>
void FillHolesIteratively(std::vector<Item> open, const Fill& fill, const Know& know)
{
  std::vector<Item> filled;
  do
  {
    filled.clear();
    std::vector<Item> rest;
    for (const Item& item : open)
    {
      (fill(item) ? filled : rest).push_back(item);
    }
    for (const Item& item : filled)
    {
      know(item);
    }
    open = std::move(rest);
  } while (!filled.empty());
}
}

#endif
